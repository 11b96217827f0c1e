// Recorded replies of language models to requests on the gallery's models, in recordings/<model>.json beside the page.
// web/tools/recordings.mjs writes those files.
import * as v from 'valibot';

const recordingsSchema = v.object({
  /** `suggest`: false for what is answered when it is asked, but is no example to follow. */
  requests: v.array(
    v.object({ request: v.string(), mentioned: v.array(v.string()), suggest: v.exactOptional(v.boolean()) }),
  ),
  /** Texts of the replies, by vote, by hash of the prompt. */
  replies: v.record(v.string(), v.array(v.string())),
  /** Who answered. */
  models: v.array(v.string()),
});
export type Recordings = v.InferOutput<typeof recordingsSchema>;
export type RecordedRequest = Recordings['requests'][number];

const loading = new Map<string, Promise<Recordings | null>>();

/** Null when nothing is recorded for this model. */
export function loadRecordings(gallery: string): Promise<Recordings | null> {
  const found =
    loading.get(gallery) ??
    fetch(`./recordings/${gallery}.json`)
      .then(async (response) => (response.ok ? v.parse(recordingsSchema, await response.json()) : null))
      .catch(() => null);
  loading.set(gallery, found);
  return found;
}

const plain = (text: string) =>
  text
    .trim()
    .replace(/\s+/g, ' ')
    .replace(/[.!]+$/, '')
    .toLowerCase();

/** The recorded request that was meant, however its end and capitals were typed. */
export function findRecorded(
  recordings: Recordings | null,
  request: string,
  mentioned: readonly string[],
): RecordedRequest | undefined {
  const parts = [...mentioned].sort().join();
  return recordings?.requests.find(
    (known) => plain(known.request) === plain(request) && [...known.mentioned].sort().join() === parts,
  );
}
