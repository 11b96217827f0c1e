// What the page needs of a browser, checked before anything else, so that the person reads a sentence and not a blank page.

import { t } from '../texts/texts';

/** A module with one try/catch block in the exception-handling instructions that the core is compiled to. */
const exceptionsModule = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 8, 1, 6, 0, 6, 64, 25, 11, 11,
]);

export interface Support {
  /** WebAssembly with exceptions. */
  webAssembly: boolean;
  webGL2: boolean;
}

export function detectSupport(): Support {
  return {
    webAssembly: typeof WebAssembly === 'object' && WebAssembly.validate(exceptionsModule),
    webGL2: document.createElement('canvas').getContext('webgl2') !== null,
  };
}

/** The sentence for a browser that lacks something, or null when all is there. */
export function missingSupport({ webAssembly, webGL2 }: Support): string | null {
  if (!webAssembly) {
    return t`This browser cannot run WebAssembly with exceptions, which ParSEL is built on. Please use Chrome or Edge 95, Firefox 100, Safari 15.2, or newer.`;
  }
  if (!webGL2) {
    return t`This browser shows no 3D graphics (WebGL 2 is missing or switched off). Please turn on hardware acceleration in its settings, or use another browser.`;
  }
  return null;
}
