// SPDX-License-Identifier: Apache-2.0
//
// validate.mjs FOLDER FILE...: glTF files, judged by Khronos' validator, which npm has put into FOLDER. A file
// passes without errors and warnings; what there is to say of others is printed. Exit code 1 unless there
// are files, and all pass.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';

const [folder, ...files] = process.argv.slice(2);
const validator = createRequire(join(resolve(folder), 'anything.js'))('gltf-validator');
let passed = 0;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: file,
    externalResourceFunction: async (uri) =>
      new Uint8Array(await readFile(join(dirname(file), decodeURIComponent(uri)))),
  });
  const { numErrors, numWarnings, messages } = report.issues;
  const { totalVertexCount, totalTriangleCount } = report.info;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings; ` +
    `${totalVertexCount} vertices, ${totalTriangleCount} triangles`);
  for (const m of messages.slice(0, 10)) console.log(`  ${m.code} ${m.pointer ?? m.offset ?? ''}: ${m.message}`);
  if (numErrors + numWarnings === 0) passed++;
}
console.log(`result: ${passed} of ${files.length} files without errors and warnings`);
process.exitCode = files.length > 0 && passed === files.length ? 0 : 1;
