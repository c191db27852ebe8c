/**
 * Who may use what. Three floors: core knows nobody, the middle floor knows core and none of its neighbours,
 * apps join things. This table is the whole truth; there is no list of exceptions.
 */
const middle = ["languages", "controllers", "formats", "recording", "physics", "project", "protocol"];
const packages = ["core", ...middle];
const mayUse = { core: [], ...Object.fromEntries(middle.map(name => [name, ["core"]])) };

/** Outside packages that each of ours may touch. Tests may add their own tools. */
const mayInstall = {
  core: [],
  languages: [],
  controllers: ["@noble/hashes"],
  formats: ["meshoptimizer", "saxes", "xmlchars", "yaml"],
  recording: ["@mcap/", "@foxglove/", "@bokuweb/zstd-wasm"],
  physics: ["@mujoco/mujoco"],
  project: ["zod", "yjs"],
  protocol: ["zod"],
};
/** Folders of core, lowest first: each may use those before it and the files beside them that know no folder. */
const coreLayers = [
  "spatial",
  "mesh",
  "model",
  "kinematics",
  "json",
  "robots",
  "catalogue",
  "dynamics",
  "program",
  "trajectory",
  "collision",
  "physical",
  "planning",
  "paths",
  "teach",
  "checks",
];
/** Folders of core that know `spatial` alone, and that no other folder knows. */
const besideLayers = ["calibration", "vision"];
const coreFoundation = "(fault|outcomes|random|signals)[.]ts$";
const any = names => names.join("|");
const test = "[.]test[.]tsx?$|/testing/";

export default {
  forbidden: [
    ...packages.map(name => ({
      name: `${name}-knows-only-its-own`,
      severity: "error",
      comment: `${name} may use: ${mayUse[name].join(", ") || "nobody"}`,
      from: { path: `^packages/${name}/` },
      to: { path: "^(packages|apps)/", pathNot: `^packages/(${any([name, ...mayUse[name]])})/` },
    })),
    ...packages.map(name => ({
      name: `${name}-installs-only`,
      severity: "error",
      comment: mayInstall[name].join(", ") || "no runtime dependency at all",
      from: { path: `^packages/${name}/`, pathNot: test },
      to: {
        dependencyTypes: ["npm", "npm-dev", "npm-peer", "npm-optional", "npm-no-pkg", "npm-unknown", "core", "unknown"],
        pathNot: ["^packages/", ...mayInstall[name].map(dep => `node_modules/${dep}`)],
      },
    })),
    ...[...coreLayers, ...besideLayers].map((name, i) => ({
      name: `core-${name}-uses-lower-layers`,
      severity: "error",
      comment: `core's folders are layers: ${coreLayers.join(" < ")}`,
      from: { path: `^packages/core/src/${name}/`, pathNot: test },
      to: {
        path: "^packages/core/src/",
        pathNot: [
          `^packages/core/src/(${any(besideLayers.includes(name) ? ["spatial", name] : coreLayers.slice(0, i + 1))})/`,
          `^packages/core/src/${coreFoundation}`,
        ],
      },
    })),
    {
      name: "through-the-front-door",
      severity: "error",
      comment: "import a package by its name and its exports, not by a path into its src",
      from: { path: "^(packages|apps)/([^/]+)/" },
      to: {
        path: "^packages/([^/]+)/src/",
        pathNot: ["^packages/$2/", "^packages/[^/]+/src/(index|[^/]+/index)[.]ts$"],
      },
    },
    {
      name: "vendors-are-strangers",
      severity: "error",
      comment: "brands and dialects meet only in the port above them and in the shared folders named here",
      from: { path: "^packages/(controllers|languages)/src/([^/]+)/", pathNot: "/testing/" },
      to: {
        path: "^packages/(controllers|languages)/src/[^/]+/",
        pathNot:
          "^packages/[^/]+/src/($2|parser|reading|emitter|transport|http|guard|cell|twin|virtual|driver|connection|runner|testing)/",
      },
    },
    {
      name: "adapter-and-virtual-are-strangers",
      severity: "error",
      comment: "they share the codec and nothing else",
      from: { path: "^packages/controllers/src/([^/]+)/(adapter|virtual)(/|[.]ts$)", pathNot: "[.]test[.]ts$" },
      to: {
        path: "^packages/controllers/src/$1/(adapter|virtual)(/|[.]ts$)",
        pathNot: "^packages/controllers/src/$1/$2(/|[.]ts$)",
      },
    },
    {
      name: "features-are-strangers",
      severity: "error",
      comment: "features meet in stores/ or in packages/",
      from: { path: "^apps/studio/src/features/([^/]+)/" },
      to: { path: "^apps/studio/src/features/", pathNot: "^apps/studio/src/features/$1/" },
    },
    {
      name: "scene-knows-no-feature",
      severity: "error",
      comment: "the scene draws what the stores say",
      from: { path: "^apps/studio/src/scene/" },
      to: { path: "^apps/studio/src/features/" },
    },
    {
      name: "apps-are-strangers",
      severity: "error",
      comment: "the cli may use the server through its front door; nobody uses the cli",
      from: { path: "^apps/([^/]+)/" },
      to: { path: "^apps/", pathNot: ["^apps/$1/", "^apps/server/src/index[.]ts$"] },
    },
    {
      name: "only-cli-meets-server",
      severity: "error",
      from: { path: "^apps/(?!cli/|server/)" },
      to: { path: "^apps/server/" },
    },
    {
      name: "stores-see-no-picture",
      severity: "error",
      comment: "stores run in Node without React or three",
      from: { path: "^apps/studio/src/(stores|runtime)/" },
      to: { path: "node_modules/(react|three|@react-three)" },
    },
    { name: "resolves", severity: "error", from: {}, to: { couldNotResolve: true } },
    { name: "no-circles", severity: "error", from: {}, to: { circular: true } },
    { name: "tests-are-leaves", severity: "error", from: { pathNot: `${test}|browser-tests/` }, to: { path: test } },
  ],
  options: {
    tsPreCompilationDeps: true,
    tsConfig: { fileName: "tsconfig.base.json" },
    doNotFollow: { path: "node_modules" },
    exclude: { path: "/dist/" },
    enhancedResolveOptions: {
      exportsFields: ["exports"],
      conditionNames: ["import", "types", "default"],
      extensions: [".ts", ".tsx", ".js", ".mjs"],
    },
  },
};
