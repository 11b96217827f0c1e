// The requests that can be tried without a key.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { loadRecordings, type RecordedRequest } from '../llm/recordings';
import { document } from '../session/session';

/** The recorded requests of the present gallery model. */
export function useRecorded(): readonly RecordedRequest[] {
  const found = useSignal<readonly RecordedRequest[]>([]);
  const source = document.value.model?.source;
  const gallery = source?.kind === 'gallery' ? source.id : null;
  useEffect(() => {
    let current = true;
    found.value = [];
    if (gallery !== null)
      void loadRecordings(gallery).then((recordings) => {
        if (current) found.value = recordings?.requests ?? [];
      });
    return () => {
      current = false;
    };
  }, [gallery, found]);
  return found.value;
}
