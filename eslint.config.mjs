import ts from "typescript-eslint";
import hooks from "eslint-plugin-react-hooks";

export default [
  { ignores: ["**/dist/**", "**/out/**", "**/node_modules/**", ".cache/**"] },
  ...ts.configs.strict.map(config => ({ ...config, files: ["**/*.ts", "**/*.tsx"] })),
  {
    files: ["**/*.ts", "**/*.tsx"],
    rules: {
      "@typescript-eslint/no-non-null-assertion": "off", // indices into typed arrays are the daily bread here
      "@typescript-eslint/no-explicit-any": "error",
      "@typescript-eslint/no-unused-vars": ["error", { argsIgnorePattern: "^_", ignoreRestSiblings: true }],
      "@typescript-eslint/unified-signatures": "off",
      "no-empty": ["error", { allowEmptyCatch: false }],
      "one-var": ["error", "never"],
      // The formatter keeps code to its width; comments it leaves as they are.
      "max-len": ["error", { code: 10_000, comments: 120, ignoreUrls: true }],
      eqeqeq: ["error", "always", { null: "ignore" }],
    },
  },
  {
    files: ["apps/studio/src/**/*.tsx", "apps/studio/src/**/*.ts"],
    plugins: { "react-hooks": hooks },
    rules: { "react-hooks/rules-of-hooks": "error", "react-hooks/exhaustive-deps": "error" },
  },
  {
    files: ["packages/*/src/**/*.ts"],
    ignores: ["**/*.test.ts", "**/testing/**"],
    rules: {
      "no-restricted-globals": ["error", { name: "Date", message: "Time is an argument below the roof." }],
      "no-restricted-properties": [
        "error",
        {
          object: "Math",
          property: "random",
          message: "Randomness is an argument below the roof: pass a seeded generator.",
        },
      ],
    },
  },
  {
    // Folders in which every function and file keeps to the limits.
    files: [
      "packages/core/src/**/*.ts",
      "packages/physics/src/**/*.ts",
      "packages/project/src/**/*.ts",
      "packages/languages/src/**/*.ts",
      "packages/controllers/src/**/*.ts",
    ],
    ignores: ["packages/core/src/teach/**", "packages/project/src/sharing/**", "**/*.test.ts", "**/testing/**"],
    rules: { "max-lines-per-function": ["error", 100], complexity: ["error", 20], "max-lines": ["error", 600] },
  },
];
