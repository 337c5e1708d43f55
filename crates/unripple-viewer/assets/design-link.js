// A surface file in a link: after `#`, deflated and in letters that addresses may hold.
//
// `#surface-1=DATA`: 1 is the version of this format, DATA the bytes of the text in UTF-8, as raw deflate, in base64url without padding.

const NAME = 'surface-';
const VERSION = 1;

/** Bytes of the largest surface file that is taken, as by the server. */
export const LARGEST = 256 * 1024;

/** Characters of the longest link that is read: what does not shrink at all grows by a third in base64, and by a little in deflate. */
const LONGEST = 4 * Math.ceil((LARGEST + 1024) / 3);

/** Bytes that are given to one call of a function as arguments; browsers take some 100 000. */
const AT_ONCE = 8192;

/** A link that holds no surface; its message says what was expected and what was found. */
export class LinkFault extends Error {}

function base64(bytes) {
  let letters = '';
  for (let i = 0; i < bytes.length; i += AT_ONCE) letters += String.fromCharCode(...bytes.subarray(i, i + AT_ONCE));
  return btoa(letters).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

function bytesOf(letters) {
  if (!/^[\w-]+$/.test(letters) || letters.length % 4 === 1) {
    throw new LinkFault('the link is damaged: expected letters, digits, - and _, as it was copied');
  }
  return Uint8Array.from(atob(letters.replaceAll('-', '+').replaceAll('_', '/')), (letter) => letter.charCodeAt(0));
}

/** What a stream gives for some bytes, up to `most` of them. */
async function through(stream, bytes, most) {
  const writer = stream.writable.getWriter();
  // What is wrong with the bytes is told where they are read.
  writer.write(bytes).catch(() => {});
  writer.close().catch(() => {});
  const parts = [];
  let length = 0;
  const reader = stream.readable.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return new Blob(parts).arrayBuffer();
    length += value.length;
    if (length > most) {
      reader.cancel().catch(() => {});
      throw new LinkFault(`the surface in the link is too large: expected at most ${most / 1024} KiB`);
    }
    parts.push(value);
  }
}

/** The part of a link, `#` included, that holds the text of a surface file. */
export async function toHash(text) {
  const packed = await through(new CompressionStream('deflate-raw'), new TextEncoder().encode(text), Infinity);
  return `#${NAME}${VERSION}=${base64(new Uint8Array(packed))}`;
}

/** Whether the part of a link from `#` on is meant to hold a surface. */
export const holdsSurface = (hash) => hash.startsWith(`#${NAME}`);

/**
 * The text of the surface file in a link, which is just the one that was put in; `null` for a link that holds none. Rejects with a
 * `LinkFault` for a link of another version, one that is damaged, and one whose text is too large.
 */
export async function fromHash(hash) {
  if (!holdsSurface(hash)) return null;
  const [, version, letters] = /^#surface-(\d{1,9})=(.*)$/s.exec(hash) ?? [];
  if (version === undefined) throw new LinkFault(`the link is damaged: expected #${NAME}${VERSION}= and the surface`);
  if (Number(version) !== VERSION) {
    throw new LinkFault(`the link is of version ${version}: this page reads version ${VERSION}`);
  }
  if (letters.length > LONGEST) {
    throw new LinkFault(`the link is too long: expected at most ${LONGEST} characters, found ${letters.length}`);
  }
  const packed = bytesOf(letters);
  let bytes;
  try {
    bytes = await through(new DecompressionStream('deflate-raw'), packed, LARGEST);
  } catch (error) {
    if (error instanceof LinkFault) throw error;
    throw new LinkFault('the link is damaged: what it holds cannot be inflated. Was it copied as a whole?');
  }
  try {
    // A mark of the byte order would belong to the text.
    return new TextDecoder('utf-8', { fatal: true, ignoreBOM: true }).decode(bytes);
  } catch {
    throw new LinkFault('the link is damaged: expected a text, found bytes that are none');
  }
}
