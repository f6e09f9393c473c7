// The page's data: base64 of deflated JSON, with long rows of numbers as running sums of integers.

/** The data in `node`, a <script> element; null where the page has none. */
export async function read_data(node) {
  if (!node) return null;
  const packed = Uint8Array.from(atob(node.textContent.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return JSON.parse(await new Response(stream).text());
}

/** `count` values of a channel: a constant, or o + s (q_0 + … + q_k); NaN where there is none. */
export function values_of(channel, count) {
  if (typeof channel === 'number') return new Array(count).fill(channel);
  if (!channel || !channel.q) return new Array(count).fill(NaN);
  let sum = 0;
  return channel.q.map((step) => {
    if (step === null) return NaN;
    sum += step;
    return channel.o + channel.s * sum;
  });
}

/** How many values a channel has; `otherwise` for a constant. */
export function count_of(channel, otherwise = 1) {
  return channel && channel.q ? channel.q.length : otherwise;
}
