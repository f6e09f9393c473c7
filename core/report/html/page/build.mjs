// Bundles the page's script: node build.mjs FOLDER
// FOLDER holds node_modules; page.js, licences.txt and page_script.cpp are written into it.
import { createRequire } from 'node:module';
import { existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const folder = resolve(process.argv[2]);
const here = dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(join(folder, 'package.json'))('esbuild');

// three.js from its sources, whose shaders come with comments and indents that nobody needs here.
const shaders = {
  name: 'shaders',
  setup(build) {
    build.onLoad({ filter: /three.src.renderers.shaders.*\.glsl\.js$/ }, ({ path }) => ({
      contents: readFileSync(path, 'utf8').replaceAll(/\/\*[^]*?\*\/|\/\/.*$/gm, '')
        .replaceAll(/[ \t]+/g, ' ').replaceAll(/\s*\n\s*/g, '\n'),
    }));
  },
};

const result = await esbuild.build({
  entryPoints: [join(here, 'src/main.js')],
  nodePaths: [join(folder, 'node_modules')],
  alias: { three: join(folder, 'node_modules/three/src/Three.js') },
  plugins: [shaders],
  loader: { '.css': 'text' },
  absWorkingDir: folder,
  bundle: true,
  format: 'iife',
  target: 'es2022',
  minify: true,
  legalComments: 'eof',
  charset: 'ascii',
  define: { 'process.env.NODE_ENV': '"production"' },
  metafile: true,
  write: false,
  logLevel: 'warning',
});

// An inline script ends at the first </script, and <!-- with <script hides that end.
const script = result.outputFiles[0].text.replaceAll('\r', '\\r');
for (const trap of ['</script', '<script', '<!--']) {
  if (script.toLowerCase().includes(trap)) throw new Error(`the bundle contains "${trap}"`);
}

writeFileSync(join(folder, 'page.js'), script);
const licences = licencesOf(Object.keys(result.metafile.inputs));
writeFileSync(join(folder, 'licences.txt'), licences);
writeFileSync(join(folder, 'page_script.cpp'), sourceOf({ kPageScript: script, kPageLicences: licences }));

// The texts under which the packages that these files come from may be passed on.
function licencesOf(inputs) {
  const names = new Set();
  for (const input of inputs) {
    const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (found) names.add(found[1]);
  }
  return [...names].sort().map((name) => {
    const home = join(folder, 'node_modules', name);
    const { version, license } = JSON.parse(readFileSync(join(home, 'package.json'), 'utf8'));
    const texts = readdirSync(home).filter((file) => /^(licen[cs]e|notice|copyrightnotice)(\.|$)/i.test(file)).sort();
    if (!texts.some((file) => /^licen[cs]e(\.|$)/i.test(file))) throw new Error(`${name} has no licence text`);
    const more = join(home, 'licenses');
    if (existsSync(more)) texts.push(...readdirSync(more).sort().map((file) => join('licenses', file)));
    const bodies = texts.map((file) => `${readFileSync(join(home, file), 'utf8').trim()}\n`);
    return `${name} ${version} (${license})\n\n${bodies.join('\n')}`.replaceAll('\r', '');
  }).join(`\n${'-'.repeat(80)}\n\n`);
}

// C++ in raw literals of a size that every compiler takes.
function sourceOf(texts) {
  const definitions = Object.entries(texts).map(([name, text]) => {
    if (text.includes(')page"')) throw new Error(`${name} contains the end of a raw literal`);
    const parts = [];
    for (let at = 0; at < text.length; at += 16000) {
      parts.push(`R"page(${text.slice(at, at + 16000)})page"`);
    }
    return `constexpr char ${name}Text[] =\n${parts.join('\n')};\n` +
      `const std::string_view ${name}{${name}Text, sizeof ${name}Text - 1};\n`;
  });
  return '#include "report/html/page_script.h"\n\nnamespace slipcheck {\n\n' +
    `${definitions.join('\n')}\n}  // namespace slipcheck\n`;
}
