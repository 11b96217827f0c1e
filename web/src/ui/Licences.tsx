// Whose the page is, and where its source is.
import { t } from '../texts/texts';

/** The build puts both files beside the page. */
export function Licences() {
  return (
    <p>
      {t`Free software, GPL 3 or later:`}{' '}
      <a href="./licences.txt" target="_blank" rel="noopener">
        {t`licences`}
      </a>
      ,{' '}
      <a href="./source.tar.gz" download>
        {t`source`}
      </a>
    </p>
  );
}
