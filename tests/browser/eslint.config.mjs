// The rules by which viewer/*.js and these tests are linted (stage browser of .ci/run), from the folder of the project.
import js from "@eslint/js";

const browser = [
  "window",
  "document",
  "location",
  "history",
  "navigator",
  "matchMedia",
  "getComputedStyle",
  "fetch",
  "atob",
  "requestAnimationFrame",
  "setTimeout",
  "ResizeObserver",
  "URL",
  "URLSearchParams",
  "Blob",
  "Worker",
  "ImageData",
  "Response",
  "DecompressionStream",
  "postMessage",
  "createImageBitmap",
  "OffscreenCanvas",
];
const node = ["process", "URL"];
const known = (names) => Object.fromEntries(names.map((name) => [name, "readonly"]));

const rules = {
  ...js.configs.recommended.rules,
  "array-callback-return": "error",
  complexity: ["error", 20],
  "consistent-return": "error",
  "default-case-last": "error",
  eqeqeq: "error",
  "max-lines": ["error", 400],
  "max-lines-per-function": ["error", 70],
  "no-alert": "error",
  "no-console": "error",
  "no-else-return": "error",
  "no-eval": "error",
  "no-implicit-globals": "error",
  "no-implied-eval": "error",
  "no-new-func": "error",
  "no-return-assign": ["error", "except-parens"],
  "no-shadow": "error",
  "no-unmodified-loop-condition": "error",
  "no-use-before-define": ["error", { functions: false }],
  "no-useless-return": "error",
  "no-var": "error",
  "object-shorthand": "error",
  "prefer-const": "error",
  "prefer-template": "off",
  "require-atomic-updates": "off",
  // Markup from a scene would be executed in the page.
  "no-restricted-properties": [
    "error",
    ...["innerHTML", "outerHTML", "insertAdjacentHTML", "write"].map((property) => ({ property })),
  ],
};

export default [
  { linterOptions: { reportUnusedDisableDirectives: "error" } },
  {
    files: ["viewer/*.js"],
    languageOptions: { sourceType: "module", globals: { ...known(browser), onmessage: "writable" } },
    rules,
  },
  {
    files: ["tests/browser/*.mjs"],
    languageOptions: { globals: known([...browser, ...node]) },
    rules: { ...rules, "max-lines-per-function": "off" },
  },
];
