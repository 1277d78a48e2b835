// Runs a WebAssembly program that only writes: `node tests/bits/wasi.mjs program.wasm >file`. Into a file: what Node writes
// into a pipe may not wait until the pipe has room, and the program is then told that it failed.
import { readFile } from 'node:fs/promises';
import { argv } from 'node:process';
import { WASI } from 'node:wasi';

const wasi = new WASI({ version: 'preview1', args: argv.slice(2) });
const program = await WebAssembly.compile(await readFile(argv[2]));
wasi.start(await WebAssembly.instantiate(program, wasi.getImportObject()));
