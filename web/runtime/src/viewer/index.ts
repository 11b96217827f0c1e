// The entry `parsel-runtime/viewer`: defines <parsel-viewer>.
import { ParselViewer } from './element';

export { ParselError } from '../error';
export { ParselViewer, type ViewerEvents } from './element';

declare global {
  interface HTMLElementTagNameMap {
    'parsel-viewer': ParselViewer;
  }
}

if (typeof customElements !== 'undefined' && customElements.get('parsel-viewer') === undefined) {
  customElements.define('parsel-viewer', ParselViewer);
}
