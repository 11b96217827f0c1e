// Providers and gateways echo keys in their refusals, whole or in part. What comes back from them is shown, kept and
// quoted, so that keys are taken out of it where it arrives.

/** A run of a key that is as long as this counts as the key; shorter ones are in texts by chance. */
const shortestRun = 12;
/** What is shorter than this guards nothing ("ollama", "x"), and its letters are needed for words. */
const shortestKey = 8;
const mark = '[key]';

/** A function that takes every run of the key out of a text, in whatever case or coding it stands there. */
export function redactorOf(key: string): (text: string) => string {
  if (key.length < shortestKey) return (text) => text;
  const run = Math.min(shortestRun, key.length);
  const runs = new Set<string>();
  for (const coded of [key, encodeURIComponent(key)].map(fold)) {
    for (let i = 0; i + run <= coded.length; i++) runs.add(coded.slice(i, i + run));
  }
  return (text) => {
    const folded = fold(text);
    let clean = '';
    let done = 0;
    for (let i = 0; i + run <= text.length; ) {
      if (!runs.has(folded.slice(i, i + run))) {
        i++;
        continue;
      }
      let end = i + run;
      while (end < text.length && runs.has(folded.slice(end - run + 1, end + 1))) end++;
      clean += text.slice(done, i) + mark;
      done = i = end;
    }
    return clean + text.slice(done);
  };
}

/** Lower case of ASCII, which keys are made of; other letters may change their length. */
const fold = (text: string) => text.replace(/[A-Z]+/g, (letters) => letters.toLowerCase());

/** Every text of a JSON value. The nesting has been limited before. */
export function redactedJson(json: unknown, redact: (text: string) => string): unknown {
  if (typeof json === 'string') return redact(json);
  if (Array.isArray(json)) return json.map((item) => redactedJson(item, redact));
  if (typeof json !== 'object' || json === null) return json;
  return Object.fromEntries(Object.entries(json).map(([name, item]) => [name, redactedJson(item, redact)]));
}
