// Hosts that models may be fetched from besides the page's own and this machine. The page's Content-Security-Policy is
// made from the same list (web/csp.ts); whoever builds the page may set another: PARSEL_MODEL_HOSTS.

export const defaultHosts = 'cdn.jsdelivr.net raw.githubusercontent.com';

/** Names of hosts, with or without a port, in a list with commas or spaces. @throws Error for what is no such name */
export function hostsOf(list: string): string[] {
  const names = list.split(/[\s,]+/).filter(Boolean);
  for (const name of names)
    if (!/^[a-z0-9-]+(\.[a-z0-9-]+)+(:\d+)?$/.test(name))
      throw new Error(`PARSEL_MODEL_HOSTS: “${name}” is no host; write names such as cdn.jsdelivr.net`);
  return names;
}

declare const __MODEL_HOSTS__: string | undefined;

/** Of this page. */
export const modelHosts: readonly string[] = hostsOf(
  typeof __MODEL_HOSTS__ === 'undefined' ? defaultHosts : __MODEL_HOSTS__,
);

/** Whether the page may fetch a model from there. They are asked over https only. */
export function mayFetchFrom(url: URL, own: string): boolean {
  const isLocal = url.hostname === 'localhost' || url.hostname === '127.0.0.1';
  return url.origin === own || isLocal || (url.protocol === 'https:' && modelHosts.includes(url.host));
}
