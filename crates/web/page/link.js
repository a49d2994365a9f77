// Links: a view of a scene, compressed, in the fragment of an address, so that no server sees it.

// Browsers and mail programs take addresses of this length.
const LONGEST = 30_000;
// What is read is cut off here: no scene of a link is so long.
const MOST_BYTES = 16 << 20;

async function through(bytes, transform) {
  const stream = new Blob([bytes]).stream().pipeThrough(transform);
  const parts = [];
  let length = 0;
  for await (const part of stream) {
    length += part.byteLength;
    if (length > MOST_BYTES) {
      throw new Error("too long");
    }
    parts.push(part);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

function toText(bytes) {
  let codes = "";
  for (const byte of bytes) {
    codes += String.fromCharCode(byte);
  }
  return btoa(codes).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

function toBytes(text) {
  const codes = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  return Uint8Array.from(codes, (code) => code.charCodeAt(0));
}

// The address of a view, or `null` when it would be too long.
export async function addressOf(view) {
  const packed = await through(new TextEncoder().encode(view), new CompressionStream("deflate-raw"));
  const address = `${location.origin}${location.pathname}#view=${toText(packed)}`;
  return address.length <= LONGEST ? address : null;
}

// The view in a fragment. What cannot be read is left to the studio, which says so.
export async function viewIn(text) {
  try {
    return new TextDecoder().decode(await through(toBytes(text), new DecompressionStream("deflate-raw")));
  } catch (error) {
    console.warn("The link is damaged:", error);
    return "";
  }
}
