// The look of the reports: one static page, no script.

export const escaped = (text) =>
  String(text).replace(/[&<>"']/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;', "'": '&#39;' })[c]);

const cell = (value) => `<td>${escaped(value)}</td>`;
/** @param head texts. @param rows lists of texts */
export const table = (head, rows) =>
  `<table><thead><tr>${head.map((h) => `<th>${escaped(h)}</th>`).join('')}</tr></thead><tbody>${rows
    .map((row) => `<tr>${row.map(cell).join('')}</tr>`)
    .join('')}</tbody></table>`;

const style = `body{font:14px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:1180px;padding:0 1rem;color-scheme:light dark;
color:light-dark(#222,#ddd);background:light-dark(#fff,#17181a)}table{border-collapse:collapse;margin:0 0 1.5rem}
th,td{padding:.2rem .7rem .2rem 0;text-align:right;border-bottom:1px solid #8884;font-variant-numeric:tabular-nums}
th:first-child,td:first-child,:is(th,td):nth-child(4):last-child{text-align:left}.wide{overflow-x:auto}figure{margin:0 0 1.2rem}
figure img{width:33%;background:light-dark(#f1f1ef,#232527);border-radius:4px}figcaption{margin-bottom:.3rem;overflow-wrap:anywhere}`;
export const pageOf = (title, body) =>
  `<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>${escaped(title)}</title><style>${style}</style><h1>${escaped(title)}</h1>${body}</html>`;
