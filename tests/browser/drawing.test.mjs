// The drawing of the page of carom view, tested in a real browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { coloursAt, drawn, restScene, Workshop } from "./view_support.mjs";

const shop = new Workshop();
before(async () => {
  await shop.open();
  shop.run("rest", restScene());
});
after(() => shop.close());

test("pixels are coloured where disks are, on both edges of a periodic side, and nowhere else", async () => {
  const { page } = await shop.show(shop.view("rest").file);
  await page.selectOption("#colour", "fixed");
  await drawn(page, 0);
  const blue = [0, 0x72, 0xb2];
  const places = [
    [5, 3],
    [12.5, 9],
    [16, 4.6],
    [0.6, 6],
    [19.6, 6],
  ]; // the last one is disk 3, across the side
  for (const colour of await coloursAt(page, places)) assert.deepEqual(colour, blue);
  const ground = await page.evaluate(() => window.carom.colours.ground);
  const empty = ground.match(/\w\w/g).map((hex) => parseInt(hex, 16));
  for (const colour of await coloursAt(page, [
    [8, 6],
    [5, 4.4],
    [1.6, 6],
    [18.6, 6],
  ]))
    assert.deepEqual(colour, empty);
  await page.close();
});

test("the page draws again when it gets the graphics card back that it has lost, and says so until then", async () => {
  const { page } = await shop.show(shop.view("rest").file);
  await page.selectOption("#colour", "fixed");
  await drawn(page, 0);
  await page.evaluate(() => {
    window.card = window.carom.renderer.gl.getExtension("WEBGL_lose_context");
    window.card.loseContext();
  });
  await page.waitForFunction(() => !document.getElementById("message").hidden);
  assert.match(await page.textContent("#message"), /^This page has lost the graphics card\./);
  await page.evaluate(() => window.card.restoreContext());
  await page.waitForFunction(() => document.getElementById("message").hidden);
  await drawn(page, 0);
  assert.deepEqual(await coloursAt(page, [[5, 3]]), [[0, 0x72, 0xb2]]);
  await page.close();
});

test("an inner sink along a side is an opening in it", async () => {
  const walls = restScene().replace('left = "periodic"\nright = "periodic"\n', "").replace("[0.2, 6]", "[2, 6]");
  shop.run("pocket", walls.replace("[run]", '[[walls]]\nfrom = [8, 0]\nto = [12, 0]\nkind = "sink"\n[run]'));
  const { page } = await shop.show(shop.view("pocket").file);
  await drawn(page, 0);
  const [ground, ink] = await page.evaluate(() =>
    ["ground", "ink"].map((name) => window.carom.colours[name].match(/\w\w/g).map((part) => parseInt(part, 16))),
  );
  const along = await coloursAt(
    page,
    Array.from({ length: 40 }, (_, k) => [8.5 + (3 * k) / 40, 0]),
  );
  const empty = along.filter((colour) => String(colour) === String(ground)).length;
  assert.ok(empty > 10 && empty < 38, `dots: ${empty} of 40 places are empty`);
  for (const colour of await coloursAt(page, [
    [5, 0],
    [15, 0],
  ]))
    assert.deepEqual(colour, ink, "a wall on either side");
  await page.close();
});

test("obstacles and inner walls stand where they are, and a moving side where it is in each frame", async () => {
  const hex = (page, name) =>
    page.evaluate((n) => window.carom.colours[n].match(/\w\w/g).map((part) => parseInt(part, 16)), name);
  const showAt = async (name, scene, words) => {
    shop.run(name, scene);
    const { page } = await shop.show(shop.view(name).file, "#t=1.5");
    await drawn(page, 3);
    assert.match(await page.textContent("#sides"), words);
    return page;
  };
  const obstacle = restScene().replace(
    "[run]",
    "[[disks]]\nfixed = true\ncount = 1\npositions = [[19.8, 1]]\nradius = 0.5\n[[walls]]\nfrom = [8, 5]\nto = [8, 7]\n[run]",
  );
  let page = await showAt("fixed", obstacle, /walls are whole lines.* 1 obstacle grey/);
  const grey = await hex(page, "faint");
  assert.deepEqual(
    await coloursAt(page, [
      [19.6, 1],
      [0.15, 1.1],
    ]),
    [grey, grey],
    "on both edges of the periodic side",
  );
  assert.deepEqual(await coloursAt(page, [[20.15, 1]]), [await hex(page, "ground")], "and not beyond it");
  assert.deepEqual(await coloursAt(page, [[8, 6]]), [await hex(page, "ink")], "an inner wall");
  await page.close();
  const inside = restScene().replace('left = "periodic"\nright = "periodic"\n', "").replace("[0.2, 6]", "[2, 6]");
  page = await showAt(
    "moving",
    inside.replace("[[disks]]", "[box.top]\nmotion = { velocity = [0.0, -0.8] }\n[[disks]]"),
    /top moving wall/,
  );
  assert.deepEqual(
    await coloursAt(page, [
      [10, 10.8],
      [10, 11.5],
    ]),
    [await hex(page, "ink"), await hex(page, "ground")],
  );
  await page.close();
});

test("large disks and small ones are drawn alike, and disks that reach into view are not lost", async () => {
  shop.run("small", restScene().replace("radius = 1.0", "radius = 0.4").replace("[0.2, 6]", "[0.6, 6]"));
  const { page } = await shop.show(shop.view("small").file);
  await page.selectOption("#colour", "fixed");
  await drawn(page, 0);
  const points = () => page.evaluate(() => window.carom.renderer.asPoints);
  const blue = [0, 0x72, 0xb2];
  assert.equal(await points(), true);
  assert.deepEqual(
    await coloursAt(page, [
      [5, 3],
      [5.3, 3],
      [12, 9.3],
    ]),
    [blue, blue, blue],
  );
  // The centre of disk 1 is just out of view, to the left; then the same with larger disks.
  for (const asPoints of [true, false]) {
    await page.evaluate((small) => {
      const { camera } = window.carom;
      camera.scale = small ? camera.scale : 200;
      camera.fitted = false;
      camera.x = 12 + 0.15 + camera.width / 2 / camera.scale;
      camera.y = 9;
      window.carom.dirty = true;
    }, asPoints);
    await drawn(page, 0);
    const [colour] = await coloursAt(page, [[12.22, 9]]);
    assert.equal(await points(), asPoints);
    assert.deepEqual(colour, blue);
  }
  await page.close();
});

test("a click picks the disk under it, also by its image across a periodic side", async () => {
  const { page } = await shop.show(shop.view("rest").file);
  for (const [x, y, id] of [
    [5, 3, "0"],
    [12.6, 9.5, "1"],
    [16, 4, "2"],
    [19.6, 6, "3"],
    [8, 6, ""],
  ]) {
    const [px, py] = await page.evaluate(([a, b]) => window.carom.camera.toPage(a, b), [x, y]);
    await page.locator("#disks").click({ position: { x: px, y: py } });
    assert.equal(await page.inputValue("#disk"), id);
  }
  await page.fill("#disk", "2");
  await page.press("#disk", "Enter");
  assert.match(await page.textContent("#facts"), /mass1radius1place16, 4velocity0, 0speed0/);
  await page.close();
});

test("a moment between two frames is that of the frame before it, and itself where motion is smooth", async () => {
  const { page } = await shop.show(shop.view("rest").file, "#t=1.9");
  const shown = async (moment, [x, y]) => {
    await page.waitForFunction((text) => document.getElementById("time").textContent.startsWith(text), moment);
    const [px, py] = await page.evaluate(([a, b]) => window.carom.camera.toPage(a, b), [x, y]);
    await page.locator("#disks").click({ position: { x: px, y: py } });
    assert.equal(await page.inputValue("#disk"), "3", moment);
    await page.waitForFunction(() => !window.carom.dirty);
    return page.evaluate(() => {
      const { picked, playback, ahead, store } = window.carom;
      return picked.path.mark(store.frame(playback.frame), playback, ahead).place[0];
    });
  };
  const frame = await shown("t = 1.5, 4", [0.8, 6]);
  assert.ok(Math.abs(frame - 1.7) < 1e-3, frame);
  await page.check("#smooth");
  const moment = await shown("t = 1.9, 4", [3.05, 6]);
  assert.ok(Math.abs(moment - 2.1) < 1e-3, moment);
  await page.close();
});

test("a disk that crosses a periodic side goes on behind it, and its path does not cross the box", async () => {
  shop.run("cross", restScene().replace("[0.2, 6]", "[19.2, 6]"));
  const { page } = await shop.show(shop.view("cross").file, "#t=1.5&disk=3");
  await drawn(page, 3);
  const facts = await page.textContent("#facts");
  assert.ok(Math.abs(Number(/velocity([\d.]+), 0/.exec(facts)?.[1]) - 1) < 1e-3, facts);
  const { x } = await page.evaluate(() => window.carom.positions(3));
  assert.ok(Math.abs(x[3] - 0.7) < 1e-3);
  const steps = await page.evaluate(() => window.carom.store.steps(1).d[6]);
  assert.ok(Math.abs(steps - 0.5) < 1e-3, "the step across the side is a short one");
  await page.waitForFunction(() => window.carom.picked.path.points.slice(0, 4).every((point) => point));
  await page.close();
});

test("the trail of a disk that left through a sink ends where it was last", async () => {
  const scene = restScene()
    .replace('left = "periodic"\nright = "periodic"', 'left = "sink"')
    .replace("count = 4", "count = 1");
  shop.run(
    "leaves",
    scene.replace(/positions = .*/, "positions = [[4.5, 6]]").replace(/velocities = .*/, "velocities = [[-2, 0]]"),
  );
  const { page } = await shop.show(shop.view("leaves").file, "#t=2");
  await page.click("#trails");
  await drawn(page, 4);
  assert.equal((await page.evaluate(() => window.carom.positions(4))).id.length, 0, "it has left");
  const ground = await page.evaluate(() => window.carom.colours.ground.match(/\w\w/g).map((hex) => parseInt(hex, 16)));
  const inked = async (x) => {
    const scale = await page.evaluate(() => window.carom.camera.scale);
    const across = [-2, -1, 0, 1, 2].map((pixels) => [x, 6 + pixels / scale]);
    return (await coloursAt(page, across)).some((colour) => colour.join() !== ground.join());
  };
  assert.deepEqual([await inked(4), await inked(2), await inked(1), await inked(0.5)], [true, true, false, false]);
  await page.close();
});

test("a disk that is gone by the next frame has the speed of the step before, however long the next one is", async () => {
  const scene = restScene()
    .replace('left = "periodic"\nright = "periodic"', 'left = "sink"')
    .replace("count = 4", "count = 1")
    .replace(/t_end = .*/, "t_end = 1.25");
  shop.run(
    "shorter",
    scene.replace(/positions = .*/, "positions = [[3.2, 6]]").replace(/velocities = .*/, "velocities = [[-2, 0]]"),
  );
  const { page } = await shop.show(shop.view("shorter").file, "#t=1");
  await drawn(page, 2);
  assert.deepEqual(await page.evaluate(() => [...window.carom.store.times]), [0, 0.5, 1, 1.25]);
  assert.equal((await page.evaluate(() => window.carom.positions(3))).id.length, 0, "it has left");
  await page.evaluate(() => window.carom.pickId(0));
  const speed = Number(/speed([\d.]+)/.exec(await page.textContent("#facts"))[1]);
  assert.ok(Math.abs(speed - 2) < 0.01, `${speed}`);
  await page.close();
});

test("the coordination number counts neighbours across periodic sides", async () => {
  const scene = restScene()
    .replace("count = 4", "count = 3")
    .replace(/positions = .*/, "positions = [[1.05, 6], [18.95, 6], [10, 6]]");
  shop.run("near", scene.replace(/velocities = .*/, ""));
  const { page } = await shop.show(shop.view("near").file);
  await page.selectOption("#colour", "coordination");
  await page.waitForFunction(() => window.carom.counts.get(0)?.some((count) => count > 0));
  assert.deepEqual(await page.evaluate(() => [...window.carom.counts.get(0)]), [1, 1, 0]);
  await page.close();
});

test("boxes of any size that a scene may have fill the page, and speeds have their colours there", async () => {
  const colours = [];
  for (const power of ["", "e-29", "e-13", "e28"]) {
    const lengths = (line) => line.replace(/\d+(\.\d+)?/g, `$&${power}`);
    const scene = restScene().replace(/^(width|height|positions|velocities|radius).*/gm, lengths);
    shop.run(`size${power}`, scene);
    const { page, errors } = await shop.show(shop.view(`size${power}`).file);
    await drawn(page, 0);
    const { left, right, width } = await page.evaluate(() => {
      const { camera, head } = window.carom;
      return { left: camera.toPage(0, 0)[0], right: camera.toPage(head.box.width, 0)[0], width: camera.width };
    });
    assert.ok(
      left > 0 && left < 50 && right > width - 50 && right < width,
      `${power}: ${left} to ${right} of ${width}`,
    );
    const size = Number(`1${power}`);
    const places = [
      [5, 3],
      [0.6, 6],
      [8, 6],
    ]; // at rest, fast, background
    colours.push(
      await coloursAt(
        page,
        places.map((place) => place.map((length) => length * size)),
      ),
    );
    assert.deepEqual(errors, []);
    await page.close();
  }
  const [usual, ...others] = colours;
  assert.notDeepEqual(usual[0], usual[1]);
  for (const other of others) assert.deepEqual(other, usual);
});

// Disks in a sheared box: the images above move at 2. Velocities are relative to the flow 0.1 (y - 10).
const shearScene = (positions, radius, rest) => `[box]
width = 20.0
height = 20.0
left = "periodic"
right = "periodic"
bottom = "periodic"
top = "periodic"
shear_rate = 0.1
[[disks]]
count = ${positions.length}
positions = ${JSON.stringify(positions)}
radius = ${radius}
mass = 1.0
${rest}
[output]
every = 0.1
trajectory = "xyz"
`;

test("in a shear flow speeds are those of the disks, also where they cross the top or the bottom", async () => {
  const scene = shearScene(
    [
      [10, 17.05],
      [10, 2.95],
    ],
    0.5,
    "velocities = [[0, 1], [0, -1]]\n[run]\nt_end = 3.0",
  );
  shop.run("shear", scene);
  const { page } = await shop.show(shop.view("shear").file);
  // Both disks cross in the last step, whose displacement the last frame shows, too.
  const { velocities, fast, range } = await page.evaluate(() => {
    const { store, head } = window.carom;
    const speeds = [];
    for (let k = 0; k < head.frames; ++k) speeds.push([...store.steps(k).d].map((d) => d / store.steps(k).over));
    return { velocities: speeds, fast: head.fast, range: window.carom.range };
  });
  const last = velocities.pop();
  const near = (found, wanted, k) =>
    found.forEach((v, n) => assert.ok(Math.abs(v - wanted[n]) < 0.01, `frame ${k}: ${found}, not ${wanted}`));
  velocities.forEach((found, k) => near(found, [0.705, 1, -0.705, -1], k));
  near(last, [0.705 - 2, 1, -0.705 + 2, -1], "last");
  assert.ok(fast > 1.2 && fast < 1.7, `the scale of all speeds ends at ${fast}`);
  assert.ok(range[1] < 2);
  await page.close();
});

test("in a shear flow images across the top and the bottom are displaced, and are picked where they are seen", async () => {
  shop.run("sheared", shearScene([[10, 19.5]], 1.0, "[run]\nt_end = 2.0"));
  const { page } = await shop.show(shop.view("sheared").file, "#t=2");
  await page.selectOption("#colour", "fixed");
  await drawn(page, 20);
  const blue = [0, 0x72, 0xb2];
  const ground = await page.evaluate(() => window.carom.colours.ground.match(/\w\w/g).map((hex) => parseInt(hex, 16)));
  // The disk is at 11.9; the images below are displaced by -4.
  const colours = await coloursAt(page, [
    [11.9, 19.5],
    [7.9, 0.2],
    [11.9, 0.2],
  ]);
  assert.deepEqual(colours, [blue, blue, ground]);
  const pick = async (x, y) => {
    const [px, py] = await page.evaluate(([a, b]) => window.carom.camera.toPage(a, b), [x, y]);
    await page.locator("#disks").click({ position: { x: px, y: py } });
    return page.inputValue("#disk");
  };
  assert.equal(await pick(11.9, 0.2), "");
  assert.equal(await pick(7.9, 0.2), "0");
  await page.click("#images");
  await drawn(page, 20);
  const [displaced, straight] = await coloursAt(page, [
    [7.9, -0.3],
    [11.9, -0.3],
  ]);
  assert.notDeepEqual(displaced, ground);
  assert.deepEqual(straight, ground);
  await page.close();
});

test("in a shear flow the coordination number counts displaced images", async () => {
  const positions = [
    [10, 19.2],
    [10, 0.2],
    [13.8, 0.2],
  ];
  shop.run("shearnear", shearScene(positions, 0.48, "[run]\nt_end = 2.0"));
  const { page } = await shop.show(shop.view("shearnear").file, "#t=2");
  await drawn(page, 20);
  await page.selectOption("#colour", "coordination");
  await page.waitForFunction(() => window.carom.counts.get(20)?.some((count) => count > 0));
  assert.deepEqual(await page.evaluate(() => [...window.carom.counts.get(20)]), [1, 1, 0]);
  await page.close();
});
