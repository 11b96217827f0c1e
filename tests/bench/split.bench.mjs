// Splitting of a million triangles, as the page's worker does it: the WebAssembly module under Node.
//
//   node tests/bench/split.bench.mjs            (after ./web/start.sh --build-only)
//
// Prints CSV `benchmark,case,metric,value`: processor time of the second of two calls, and the module's memory.
import { loadCore } from '../../web/tools/core.mjs';
import { ballsOf, dust, scan } from './large_models.mjs';

const print = (name, metric, value) => console.log(`split wasm,${name},${metric},${value}`);

const cases = [
  ['100 balls, 1,010,000 triangles', ballsOf(100, 51), ['auto', 'components', 'regions']],
  ['1,000 balls, 1,012,000 triangles', ballsOf(1000, 23), ['auto']],
  ['a scan of 1,002,000 triangles', scan(), ['auto', 'components']],
  ['250,000 tetrahedra', dust(250_000), ['auto']],
];
for (const [name, file, ways] of cases) {
  const call = await loadCore();
  const time = (run) => {
    const start = process.cpuUsage();
    run();
    const { user, system } = process.cpuUsage(start);
    return (user + system) / 1000;
  };
  print(name, 'open ms', time(() => call('open', { name, external: [] }, [file])).toFixed(0));
  for (const by of ways) {
    let what = '';
    const split = () => {
      try {
        const { result } = call('split', { by, fine: 0.5 });
        what = `${result.parts} parts`;
      } catch (error) {
        what = error.message;
      }
    };
    const first = time(split);
    const again = time(split);
    print(`${name}, ${by}`, 'ms', again.toFixed(0));
    console.error(`${name}, ${by}: ${what}; first ${first.toFixed(0)} ms`);
  }
  print(name, 'memory MB', (call('memory', {}).result.bytes / 1e6).toFixed(0));
}
