/// The engine cannot run this scene with these settings; the message is the reason.
export class Refused extends Error {}

/// A message that breaks the protocol: nothing after it can be trusted.
export class Rubbish extends Error {}
