// Whether this page is shown inside another site's, where clicks can be lured: the viewer may be, the full page must not.

/** `?embed`: the model and its sliders, nothing else; it neither restores nor keeps anything. */
export const isEmbedded = new URLSearchParams(location.search).has('embed');

/** Whether any page around this one is of another origin. */
export function isInForeignFrame(): boolean {
  try {
    for (let frame: Window = window; frame !== frame.parent; frame = frame.parent) {
      if (frame.parent.location.origin !== location.origin) return true;
    }
    return false;
  } catch {
    return true; // a page of another origin does not say what it is
  }
}
