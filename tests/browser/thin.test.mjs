// Boxes a few pixels high, or less, on the page of carom view.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { coloursAt, drawn, Workshop } from "./view_support.mjs";

const shop = new Workshop();
before(() => shop.open());
after(() => shop.close());

// Two disks at half height.
const thinScene = (width, radius, sides) => `[box]
width = ${width}
height = 1.0
${sides}
[[disks]]
count = 2
positions = [[${width / 4}, 0.5], [${(3 * width) / 4}, 0.5]]
radius = ${radius}
mass = 1.0
[run]
method = "exact"
t_end = 1.0
[output]
trajectory = "xyz"
`;

async function show(name, scene) {
  shop.run(name, scene);
  const { page } = await shop.show(shop.view(name).file);
  await page.selectOption("#colour", "fixed");
  await drawn(page, 0);
  return page;
}

test("a periodic box so long that it is thinner than a pixel shows its disks", async () => {
  const page = await show("periodic", thinScene(4000, 0.25, 'bottom = "periodic"\ntop = "periodic"'));
  const around = [-2, -1, 0, 1, 2].map((n) => [1000, 0.5 + 2 * n]); // some pixels above and below
  const colours = await coloursAt(page, around);
  assert.ok(
    colours.some((colour) => colour[2] - colour[0] > 20),
    JSON.stringify(colours),
  );
  await page.close();
});

test("the sides of a thin box do not cover its disks", async () => {
  const page = await show("walls", thinScene(240, 0.45, ""));
  const [low, high] = await page.evaluate(() => [0, 1].map((y) => window.carom.camera.toPage(0, y)[1]));
  assert.ok(low - high > 2 && low - high < 5, `the box is ${low - high} pixels high`);
  const disks = [
    [60, 0.5],
    [180, 0.5],
  ];
  for (const colour of await coloursAt(page, disks)) {
    const off = [0, 0x72, 0xb2].map((part, k) => Math.abs(part - colour[k]));
    assert.ok(Math.max(...off) < 20, `${colour}`); // the edge of a line may colour it slightly
  }
  await page.close();
});
