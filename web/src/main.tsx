import { render } from 'preact';
import { start } from './session/core';
import { say } from './session/session';
import { t } from './texts/texts';
import { App } from './ui/App';
import { exposeForDebugging } from './ui/debug';
import { isEmbedded, isInForeignFrame } from './ui/frame';
import { speakPreferred } from './ui/language';
import { detectSupport, missingSupport } from './ui/support';

const root = document.getElementById('app');
if (root === null) throw new Error('index.html has no #app');

exposeForDebugging();
// A piece that is loaded late is gone when the server has a newer version.
addEventListener('vite:preloadError', (event) => {
  event.preventDefault();
  say(t`A part of the page is no longer there: it was updated meanwhile. Reload the page; your work is kept.`, 'error');
});
const isFramed = isInForeignFrame() && !isEmbedded;
const isSupported = missingSupport(detectSupport()) === null;
if (!isFramed && isSupported) void start(); // the core is on its way while the words are fetched
await speakPreferred();
if (isFramed) {
  render(<Framed />, root);
} else if (!isSupported) {
  render(
    <main class="notice">
      <h1>ParSEL</h1>
      <p>{missingSupport(detectSupport())}</p>
    </main>,
    root,
  );
} else {
  render(<App />, root);
}

/** Inside another site's page, what is clicked may not be what is seen: nothing starts there. */
function Framed() {
  return (
    <main class="notice">
      <h1>ParSEL</h1>
      <p>
        {t`ParSEL does not run inside another site's page, for your safety.`}{' '}
        <a href={location.href} target="_blank" rel="noopener">
          {t`Open it by itself`}
        </a>
        .
      </p>
    </main>
  );
}
