// `npm run docs`: the manual and the reference from the types as one site, in docs/dist.
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { Application, Converter, ReflectionKind, TSConfigReader } from "typedoc";

const root = join(import.meta.dirname, "..");
const docs = (folder) =>
  readdirSync(join(import.meta.dirname, folder))
    .filter((name) => name.endsWith(".md"))
    .map((name) => join(import.meta.dirname, folder, name));

/** Tasks in the order that a newcomer meets them. */
const tasks = [
  "globe",
  "on-a-map",
  "page",
  "heights",
  "feet",
  "no-crs",
  "measuring-a-scan",
  "profile-for-gis",
  "tiles",
  "serving",
  "applications",
  "errors",
  "error-codes",
];
/** Groups of pages, as the navigation shows them. */
const groups = {
  Tasks: tasks.map((name) => join(import.meta.dirname, "manual", `${name}.md`)),
  "In depth": docs("."),
  "What accuracy costs": docs("accuracy"),
  "How fast": docs("bench"),
};
const groupOf = new Map(
  Object.entries(groups).flatMap(([group, files]) => files.map((file) => [file, group])),
);

const app = await Application.bootstrap(
  {
    name: "Groma",
    entryPoints: [
      "index.ts",
      "cesium",
      "openlayers",
      "link",
      "navigation",
      "tools",
      "plot",
      "query",
      "export",
      "sources",
    ].map((entry) => join(root, "layer/src", entry.endsWith(".ts") ? entry : `${entry}/index.ts`)),
    tsconfig: join(root, "layer/tsconfig.json"),
    out: join(import.meta.dirname, "dist"),
    emit: process.argv.includes("--check") ? "none" : "docs",
    readme: join(root, "README.md"),
    projectDocuments: [...groupOf.keys()],
    groupOrder: [...Object.keys(groups), "*"],
    sort: ["source-order"],
    excludeInternal: true,
    excludePrivate: true,
    excludeExternals: true,
    disableSources: true,
    githubPages: false,
    skipErrorChecking: true,
    // In @throws the class is named first, and stays a word.
    suppressCommentWarningsInDeclarationFiles: true,
    // Links of comments may name what a file keeps to itself.
    validation: { notExported: false, invalidLink: false, invalidPath: true },
    navigation: { includeGroups: true, compactFolders: true },
  },
  [new TSConfigReader()],
);

// A page is called by its heading and stands in its group.
app.converter.on(Converter.EVENT_CREATE_DOCUMENT, (_, document) => {
  const text = document.content.map((part) => part.text).join("");
  const heading = /^# (.*)$/m.exec(text)?.[1];
  if (heading) document.name = heading.replaceAll("`", "");
  const group = groupOf.get(document.project.files.getReflectionPath(document));
  if (group) document.frontmatter.group = group;
});

/** Options without words: whoever reads the reference has to know of each what it is. */
function untold(project) {
  return project
    .getReflectionsByKind(ReflectionKind.Interface)
    .filter(({ name }) => /(Options|Style)$/.test(name))
    .flatMap((options) => [options, ...(options.children ?? [])])
    .filter((option) => !option.hasComment())
    .map((option) => option.getFullName());
}

const project = await app.convert();
if (project) {
  app.validate(project);
  for (const name of untold(project)) app.logger.warn(`${name} says nothing of what it is`);
  if (!process.argv.includes("--check")) await app.generateOutputs(project);
}
// A link that leads nowhere, or a parameter that is not there, is an error.
process.exitCode = project && !app.logger.hasErrors() && !app.logger.hasWarnings() ? 0 : 1;
