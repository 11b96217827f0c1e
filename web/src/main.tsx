import { render } from 'preact';
import { start } from './session/core';
import { App } from './ui/App';
import { exposeForDebugging } from './ui/debug';
import { detectSupport, missingSupport } from './ui/support';

const root = document.getElementById('app');
if (root === null) throw new Error('index.html has no #app');

exposeForDebugging();
const missing = missingSupport(detectSupport());
if (missing === null) void start();
render(
  missing === null ? (
    <App />
  ) : (
    <main class="notice">
      <h1>ParSEL</h1>
      <p>{missing}</p>
    </main>
  ),
  root,
);
