// Messages on standard input and output: a length, little-endian in 4 bytes, and a body of CBOR.

import { readSync } from 'node:fs';
import { Rubbish } from './faults.mjs';

const PREFIX = 4;
export const MAX_MESSAGE = 64 * 1024 * 1024;

/// The bytes of a message, prefix and body.
export function frame(codec, message) {
  const body = codec.encode(message);
  if (body.length > MAX_MESSAGE) throw new RangeError(`a message of ${body.length} bytes is too long`);
  const bytes = Buffer.alloc(PREFIX + body.length);
  bytes.writeUInt32LE(body.length, 0);
  bytes.set(body, PREFIX);
  return bytes;
}

/// The length of the body that follows a prefix.
export function bodyLength(prefix) {
  const length = prefix.readUInt32LE(0);
  if (length > MAX_MESSAGE)
    throw new Rubbish(`a message of ${length} bytes, more than ${MAX_MESSAGE}`);
  return length;
}

/// The message that a body holds.
export function decodeBody(codec, body) {
  let message;
  try {
    message = codec.decode(body);
  } catch (error) {
    throw new Rubbish(`request is not CBOR: ${error.message}`);
  }
  if (typeof message !== 'object' || message === null || Array.isArray(message))
    throw new Rubbish('request must be a map');
  return message;
}

export class Connection {
  /// `write(bytes, offset)` writes to standard output and tells how much it wrote; `read(bytes,
  /// offset, length)` likewise from standard input, 0 at its end.
  constructor(codec, write, read = (bytes, offset, length) => readSync(0, bytes, offset, length, null)) {
    this.codec = codec;
    this.write = write;
    this.read = read;
  }

  /// The next message; undefined at the end of the input, even in the middle of a message. Throws
  /// Rubbish.
  receive() {
    const prefix = this.#readAll(PREFIX);
    if (!prefix) return undefined;
    const body = this.#readAll(bodyLength(prefix));
    return body && decodeBody(this.codec, body);
  }

  /// False when nobody listens any more.
  send(message) {
    const bytes = this.#frameOrFail(message);
    try {
      for (let sent = 0; sent < bytes.length; ) sent += patiently(() => this.write(bytes, sent));
      return true;
    } catch (error) {
      if (error.code === 'EPIPE') return false;
      throw error;
    }
  }

  #frameOrFail(message) {
    try {
      return frame(this.codec, message);
    } catch (error) {
      return frame(this.codec, { type: 'failed', reason: error.message });
    }
  }

  #readAll(length) {
    const bytes = Buffer.alloc(length);
    for (let got = 0; got < length; ) {
      const n = patiently(() => this.read(bytes, got, length - got));
      if (n === 0) return undefined;
      got += n;
    }
    return bytes;
  }
}

/// Input and output may have been made non-blocking by whoever holds their other end.
function patiently(transfer) {
  for (;;) {
    try {
      return transfer();
    } catch (error) {
      if (error.code === 'EOF') return 0;
      if (error.code !== 'EAGAIN') throw error;
      Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 1);
    }
  }
}
