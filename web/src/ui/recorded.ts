// The requests that can be tried without a key.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { loadRecordings, type RecordedRequest } from '../llm/recordings';
import { isAsFound } from '../session/document';
import { programUrls } from '../session/gallery';
import { document } from '../session/session';

/** The recorded requests of the present gallery model that are worth a try; none while labels or joints are others. */
export function useRecorded(): readonly RecordedRequest[] {
  const found = useSignal<readonly RecordedRequest[]>([]);
  const { model } = document.value;
  const source = model !== null && isAsFound(model) ? model.source : null;
  const gallery = source?.kind === 'gallery' && programUrls(source.id) === null ? source.id : null;
  useEffect(() => {
    let current = true;
    found.value = [];
    if (gallery !== null)
      void loadRecordings(gallery).then((recordings) => {
        if (current) found.value = recordings?.requests.filter(({ suggest }) => suggest !== false) ?? [];
      });
    return () => {
      current = false;
    };
  }, [gallery, found]);
  return found.value;
}
