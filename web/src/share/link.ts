// The whole work in the fragment of an address: "#v1." and deflated JSON as base64url. Nothing of it reaches a server.
import { t } from '../texts/texts';
import { type ReadResult, readSavedText, type Saved } from './saved';

/** Longer links break in mail and chat programs. */
export const linkWarningLength = 8192;
const maxInflated = 2 ** 20;
/** Deflate stores what it cannot shorten with less than 1 % on top, and base64 makes four characters of three bytes. */
const maxLength = Math.ceil((maxInflated * 1.01 * 4) / 3);
const prefix = 'v1.';

export async function fragmentOf(saved: Saved): Promise<string> {
  const stream = new Blob([JSON.stringify(saved)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  let binary = '';
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return `#${prefix}${btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')}`;
}

const refused = (text: string): ReadResult => ({ ok: false, text });

/** Reads an untrusted fragment; null when it is none of ours. */
export async function readFragment(fragment: string): Promise<ReadResult | null> {
  const version = /^#?v(\d{1,9})\./.exec(fragment);
  if (version === null) return null;
  if (version[1] !== '1') {
    return refused(t`This link was made by a newer ParSEL. Reload the page to update it, then try again.`);
  }
  const coded = fragment.slice(version[0].length);
  // Before any of it is decoded: browsers accept links of hundreds of megabytes.
  if (coded.length > maxLength) return refused(t`This link is too long. Ask for the work as a file instead.`);
  const inflated = await inflate(coded);
  if (inflated === null) return refused(t`This link is damaged: part of it is missing. Ask for it again.`);
  return readSavedText(inflated);
}

async function inflate(base64url: string): Promise<string | null> {
  try {
    const binary = atob(base64url.replaceAll('-', '+').replaceAll('_', '/'));
    const bytes = Uint8Array.from(binary, (character) => character.charCodeAt(0));
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw')).getReader();
    const decoder = new TextDecoder('utf-8', { fatal: true });
    let text = '';
    let size = 0;
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      size += part.value.length;
      if (size > maxInflated) {
        await reader.cancel();
        return null;
      }
      text += decoder.decode(part.value, { stream: true });
    }
    return text + decoder.decode();
  } catch {
    return null;
  }
}
