// node bundle.mjs SOURCES MODULES OUT: bundles SOURCES/page.js, with the packages in MODULES, and writes
// it as C++ source that defines what page_script.h declares.
import {createHash} from 'node:crypto';
import {readFileSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join, resolve} from 'node:path';

const [sources, modules, out] = process.argv.slice(2).map(path => resolve(path));
const esbuild = createRequire(join(modules, 'bundle.cjs'))('esbuild');
// Their licences go with them.
const licences = ['three', 'uplot'].map(name => `${name}: ${readFileSync(join(modules, name, 'LICENSE'), 'utf8')}`);
const {outputFiles} = await esbuild.build({
  entryPoints: [join(sources, 'page.js')],
  bundle: true,
  minify: true,
  write: false,
  charset: 'ascii',
  format: 'iife',
  target: ['chrome100', 'firefox100', 'safari15.4'],
  loader: {'.css': 'text'},
  legalComments: 'none',
  banner: {js: `/*!\n${licences.join('\n')}*/`},
  nodePaths: [modules],
  absWorkingDir: sources,
});
const script = outputFiles[0].text.replaceAll('\u00a9', '(c)').trimEnd();
const end = ')page_script"';
// The page's parser must not take a part of it for an end of the element, or for a comment.
if (/<\/script|<!--/i.test(script) || script.includes(end)) {
  throw new Error('bundle.mjs: the bundle cannot stand in a page as it is');
}
const literals = script.match(/[^]{1,16000}/g).map(part => `R"page_script(${part}${end}`);
const hash = createHash('sha256').update(script).digest('base64');
writeFileSync(out, `// Written by apps/pages/bundle.mjs.
#include "apps/pages/page_script.h"
namespace scattermeter::apps {
const std::string_view kPageScript =
${literals.join('\n')};
const std::string_view kPageScriptSha256 = "${hash}";
}  // namespace scattermeter::apps
`);
