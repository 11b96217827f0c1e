// The requests that can be tried without a key.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { loadRecordings, type RecordedRequest } from '../llm/recordings';
import { programUrls } from '../session/gallery';
import { document } from '../session/session';

/** The recorded requests of the present gallery model that are worth a try; none while parts have other labels. */
export function useRecorded(): readonly RecordedRequest[] {
  const found = useSignal<readonly RecordedRequest[]>([]);
  const { source, labels } = document.value.model ?? {};
  const isModel = source?.kind === 'gallery' && labels?.size === 0 && programUrls(source.id) === null;
  const gallery = isModel ? source.id : null;
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
