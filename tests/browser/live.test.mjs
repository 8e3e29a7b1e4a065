// A run that is going on, as shown by carom view --live.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { setTimeout as wait } from "node:timers/promises";
import { drawn, framesOf, Workshop } from "./view_support.mjs";

const shop = new Workshop();
before(() => shop.open());
after(() => shop.close());

const endless = `title = "it goes on"
[box]
width = 20.0
height = 20.0
left = "sink"
[[disks]]
count = 30
positions = "random"
velocities = { maxwell = 1.0 }
radius = 0.4
mass = 1.0
[[sources]]
side = "right"
rate = 3.0
radius = 1.2
mass = 1.0
velocities = { maxwell = 2.0 }
[run]
method = "pairwise"
dt = 2e-5
t_end = 1e6
[output]
every = 0.02
trajectory = "xyz"
series = true
`;

test("a run that goes on is followed to its end, and what has come stays", async () => {
  writeFileSync(shop.path("endless.toml"), endless);
  const run = await shop.start("run", "endless.toml", "-o", "out", "--quiet");
  const unfinished = join(shop.path("out"), "carom-unfinished");
  while (!existsSync(join(unfinished, "trajectory.xyz"))) await wait(20);
  const server = await shop.start("view", "out", "--live", "--quiet");
  const { page, requests, errors } = await shop.show(await server.line);
  const frames = () => page.evaluate(() => window.carom.head.frames);
  const begun = await frames();
  await page.waitForFunction((n) => window.carom.head.frames > n + 5, begun);
  // The page follows the run, or stays where the user puts it.
  const [at, last] = await page.evaluate(() => [window.carom.playback.frame + 1, window.carom.head.frames]);
  assert.equal(at, last);
  await page.keyboard.press("Home");
  await page.waitForFunction((n) => window.carom.head.frames > n, await frames());
  assert.equal(await page.evaluate(() => window.carom.playback.frame), 0);
  assert.equal(await page.textContent("#left-out"), "The run goes on.");
  // Disks of another group have come, larger than points can be.
  await page.waitForFunction(() => window.carom.head.grouped);
  assert.deepEqual(await page.evaluate(() => [...new Set(window.carom.store.group)]), [0, 1]);
  await page.selectOption("#colour", "group");
  await page.waitForFunction(() => document.getElementById("groups").textContent === "group 0sources");
  await page.waitForFunction(() => !window.carom.renderer.asPoints);
  run.child.kill("SIGTERM");
  assert.equal(await run.ended, 4);
  await page.waitForFunction(() => document.getElementById("left-out").textContent.startsWith("The run has stopped."));
  assert.equal(await server.ended, 0);
  // The server is gone; the page has every frame of the trajectory.
  const known = framesOf(unfinished);
  assert.equal(await frames(), known.length);
  const shown = await page.evaluate(async () => {
    const all = [];
    for (let k = 0; k < window.carom.head.frames; ++k) all.push(await window.carom.positions(k));
    return { all, times: [...window.carom.store.times], quantum: window.carom.head.axes[0].quantum };
  });
  known.forEach(({ time, disks }, k) => {
    assert.equal(shown.times[k], time);
    assert.deepEqual(
      shown.all[k].id.toSorted((a, b) => a - b),
      [...disks.keys()].sort((a, b) => a - b),
    );
    shown.all[k].id.forEach((id, i) =>
      assert.ok(Math.abs(shown.all[k].x[i] - disks.get(id).x) <= shown.quantum * 0.5000001),
    );
  });
  await page.keyboard.press("End");
  await drawn(page, known.length - 1);
  assert.deepEqual(errors, []);
  const origin = new URL(await server.line).origin;
  assert.deepEqual(
    requests.filter((url) => !url.startsWith(origin) && !url.startsWith("blob:")),
    [],
  );
  await page.close();
});

test("the page of a server that is killed says so and keeps what it has", async () => {
  const run = await shop.start("run", "endless.toml", "-o", "killed", "--quiet");
  while (!existsSync(join(shop.path("killed"), "carom-unfinished", "trajectory.xyz"))) await wait(20);
  const server = await shop.start("view", "killed", "--live", "--quiet");
  const { page } = await shop.show(await server.line);
  server.child.kill("SIGKILL");
  await page.waitForFunction(() =>
    document.getElementById("left-out").textContent.startsWith("The run cannot be followed"),
  );
  await page.keyboard.press("Home");
  await drawn(page, 0);
  run.child.kill("SIGKILL");
  await page.close();
});
