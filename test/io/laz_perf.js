// SPDX-License-Identifier: BSD-3-Clause
// Decompresses LAZ files by laz-perf (npm) and writes the records of their points beside them, as
// FILE.records: node laz_perf.js FILE...
const fs = require('fs');
const {createLazPerf} = require('laz-perf');

async function main() {
  const lib = await createLazPerf();
  for (const name of process.argv.slice(2)) {
    const bytes = fs.readFileSync(name);
    const input = lib._malloc(bytes.length);
    lib.HEAPU8.set(bytes, input);
    const reader = new lib.LASZip();
    reader.open(input, bytes.length);
    const size = reader.getPointLength();
    const point = lib._malloc(size);
    const records = Buffer.alloc(reader.getCount() * size);
    for (let place = 0; place < records.length; place += size) {
      reader.getPoint(point);
      records.set(lib.HEAPU8.subarray(point, point + size), place);
    }
    fs.writeFileSync(name + '.records', records);
    reader.delete();
    lib._free(point);
    lib._free(input);
  }
}

main();
