// Emscripten gives programs an environment of its own; the tests want the caller's. Its loader would fetch() a file
// path under Node 18 and later, so the binary is read here.
Module['wasmBinary'] = require('node:fs').readFileSync(`${__dirname}/core_tests.wasm`);
Module['preRun'] = Module['preRun'] || [];
Module['preRun'].push(() => Object.assign(ENV, process.env));
