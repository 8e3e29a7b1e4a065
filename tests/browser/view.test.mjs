// The page that carom view makes, in a real browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { coloursAt, drawn, framesOf, Workshop } from "./view_support.mjs";

const shop = new Workshop();
before(() => shop.open());
after(() => shop.close());

const openScene = `title = "disks come and go"
seed = 5
[box]
width = 20.0
height = 12.0
left = "sink"
bottom = "periodic"
top = "periodic"
[[disks]]
count = 40
positions = "random"
velocities = { uniform = 2.0 }
radius = { uniform = [0.2, 0.6] }
mass = { from_radius = 1.0 }
[[disks]]
name = "heavy"
count = 3
positions = [[3, 3], [6, 6], [9, 3]]
radius = 0.5
mass = 2.0
[[sources]]
side = "right"
rate = 4.0
radius = 0.3
mass = 1.0
velocities = { maxwell = 2.0 }
[run]
method = "exact"
t_end = 30.0
[output]
every = 0.25
trajectory = "xyz"
series = true
`;

// Disks at rest in known places, the last one on a periodic side.
const restScene = (title = "disks at rest") => `title = ${JSON.stringify(title)}
[box]
width = 20.0
height = 12.0
left = "periodic"
right = "periodic"
[[disks]]
count = 4
positions = [[5, 3], [12, 9], [16, 4], [0.2, 6]]
velocities = [[0, 0], [0, 0], [0, 0], [1, 0]]
radius = 1.0
mass = 1.0
[run]
method = "exact"
t_end = 2.0
[output]
every = 0.5
trajectory = "xyz"
`;

let open; // the run of openScene
let openPage;
before(() => {
  open = shop.run("open", openScene);
  openPage = shop.view("open").file;
  shop.run("rest", restScene());
});

test("decoded positions are the trajectory's within half a quantum", async () => {
  const frames = framesOf(open);
  const { page, requests, errors } = await shop.show(openPage);
  const shown = await page.evaluate(async () => {
    const { carom } = window;
    const all = [];
    for (let k = 0; k < carom.head.frames; ++k) all.push(await carom.positions(k));
    const table = Array.from(carom.store.id, (id, p) => [id, carom.store.radius[p], carom.store.mass[p]]);
    return { all, table, times: [...carom.store.times], quanta: carom.head.axes.map((axis) => axis.quantum) };
  });
  assert.equal(shown.all.length, frames.length);
  assert.ok(frames.some((frame, k) => k > 0 && frame.disks.size !== frames[k - 1].disks.size), "disks come and go");
  frames.forEach(({ time, disks }, k) => {
    assert.equal(shown.times[k], time);
    const { id, x, y } = shown.all[k];
    assert.deepEqual([...id].sort((a, b) => a - b), [...disks.keys()]);
    id.forEach((which, i) => {
      const disk = disks.get(which);
      const dy = Math.abs(y[i] - disk.y);
      assert.ok(Math.abs(x[i] - disk.x) <= shown.quanta[0] * 0.5000001, `x of disk ${which} in frame ${k}`);
      assert.ok(Math.min(dy, 12 - dy) <= shown.quanta[1] * 0.5000001, `y of disk ${which} in frame ${k}`);
    });
  });
  const sizes = new Map(frames.flatMap(({ disks }) => [...disks]));
  for (const [id, radius, mass] of shown.table) assert.deepEqual([radius, mass], [sizes.get(id).radius, sizes.get(id).mass]);
  assert.deepEqual(errors, []);
  assert.deepEqual(requests.filter((url) => !/^(file|blob):/.test(url)), [], "the network is not asked for anything");
  await page.close();
});

test("the page may not ask the network either", async () => {
  const { page } = await shop.show(openPage);
  const refused = await page.evaluate(() => fetch("http://127.0.0.1:9/").then(() => "answered", (error) => error.name));
  assert.equal(refused, "TypeError");
  const policy = await page.evaluate(() => document.querySelector("meta[http-equiv]").content);
  assert.match(policy, /^default-src 'none'; script-src 'sha256-/);
  await page.close();
});

test("pixels are coloured where disks are, on both edges of a periodic side, and nowhere else", async () => {
  const { page } = await shop.show(shop.view("rest").file);
  await page.selectOption("#colour", "fixed");
  await drawn(page, 0);
  const blue = [0, 0x72, 0xb2];
  const places = [[5, 3], [12.5, 9], [16, 4.6], [0.6, 6], [19.6, 6]]; // the last one: disk 3, across the side
  for (const colour of await coloursAt(page, places)) assert.deepEqual(colour, blue);
  const ground = await page.evaluate(() => window.carom.colours.ground);
  const empty = ground.match(/\w\w/g).map((hex) => parseInt(hex, 16));
  for (const colour of await coloursAt(page, [[8, 6], [5, 4.4], [1.6, 6], [18.6, 6]])) assert.deepEqual(colour, empty);
  await page.close();
});

test("obstacles and inner walls stand where they are, and a moving side where it is in each frame", async () => {
  const hex = (page, name) => page.evaluate((n) => window.carom.colours[n].match(/\w\w/g).map((part) => parseInt(part, 16)), name);
  const showAt = async (name, scene, words) => {
    shop.run(name, scene);
    const { page } = await shop.show(shop.view(name).file, "#t=1.5");
    await drawn(page, 3);
    assert.match(await page.textContent("#sides"), words);
    return page;
  };
  const obstacle = restScene().replace("[run]", "[[disks]]\nfixed = true\ncount = 1\npositions = [[19.8, 1]]\nradius = 0.5\n[[walls]]\nfrom = [8, 5]\nto = [8, 7]\n[run]");
  let page = await showAt("fixed", obstacle, /walls are whole lines.* 1 obstacles grey/);
  const grey = await hex(page, "faint");
  assert.deepEqual(await coloursAt(page, [[19.6, 1], [0.15, 1.1]]), [grey, grey], "on both edges of the periodic side");
  assert.deepEqual(await coloursAt(page, [[8, 6]]), [await hex(page, "ink")], "an inner wall");
  await page.close();
  const inside = restScene().replace('left = "periodic"\nright = "periodic"\n', "").replace("[0.2, 6]", "[2, 6]");
  page = await showAt("moving", inside.replace("[[disks]]", "[box.top]\nmotion = { velocity = [0.0, -0.8] }\n[[disks]]"), /top moving wall/);
  assert.deepEqual(await coloursAt(page, [[10, 10.8], [10, 11.5]]), [await hex(page, "ink"), await hex(page, "ground")]);
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
  assert.deepEqual(await coloursAt(page, [[5, 3], [5.3, 3], [12, 9.3]]), [blue, blue, blue]);
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
  for (const [x, y, id] of [[5, 3, "0"], [12.6, 9.5, "1"], [16, 4, "2"], [19.6, 6, "3"], [8, 6, ""]]) {
    const [px, py] = await page.evaluate(([a, b]) => window.carom.camera.toPage(a, b), [x, y]);
    await page.locator("#disks").click({ position: { x: px, y: py } });
    assert.equal(await page.inputValue("#disk"), id);
  }
  await page.fill("#disk", "2");
  await page.press("#disk", "Enter");
  assert.match(await page.textContent("#facts"), /mass1radius1place16, 4velocity0, 0speed0/);
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

test("colours, trails, arrows, images and both themes draw something else, without an error", async () => {
  const { page, errors } = await shop.show(openPage, "#t=5");
  await drawn(page, 20);
  const picture = () => page.evaluate(async () => Array.from(new Uint8Array(await (await window.carom.takePicture()).arrayBuffer())).join());
  let last = await picture();
  for (const colour of ["group", "radius", "mass", "id", "coordination", "fixed", "speed"]) {
    await page.selectOption("#colour", colour);
    await drawn(page, 20);
    if (colour === "coordination") await page.waitForFunction(() => window.carom.counts.get(20)?.some((count) => count > 0));
    const now = await picture();
    assert.notEqual(now, last, colour);
    last = now;
  }
  assert.equal(await page.locator("#groups li").count(), 0);
  await page.selectOption("#colour", "group");
  await drawn(page, 20);
  assert.deepEqual(await page.locator("#groups li").allTextContents(), ["group 1", "heavy", "sources"]);
  for (const id of ["trails", "arrows", "images", "dark"]) {
    await page.click(`#${id}`);
    await drawn(page, 20);
    const now = await picture();
    assert.notEqual(now, last, id);
    last = now;
  }
  assert.deepEqual(errors, []);
  await page.close();
});

test("the trail of a disk that left through a sink ends where it was last", async () => {
  const scene = restScene().replace('left = "periodic"\nright = "periodic"', 'left = "sink"').replace("count = 4", "count = 1");
  shop.run("leaves", scene.replace(/positions = .*/, "positions = [[4.5, 6]]").replace(/velocities = .*/, "velocities = [[-2, 0]]"));
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

test("the coordination number counts neighbours across periodic sides", async () => {
  const scene = restScene().replace("count = 4", "count = 3").replace(/positions = .*/, "positions = [[1.05, 6], [18.95, 6], [10, 6]]");
  shop.run("near", scene.replace(/velocities = .*/, ""));
  const { page } = await shop.show(shop.view("near").file);
  await page.selectOption("#colour", "coordination");
  await page.waitForFunction(() => window.carom.counts.get(0)?.some((count) => count > 0));
  assert.deepEqual(await page.evaluate(() => [...window.carom.counts.get(0)]), [1, 1, 0]);
  await page.close();
});

test("the keyboard alone reaches every control and plays the run", async () => {
  const { page } = await shop.show(openPage);
  const reached = new Set();
  for (let n = 0; n < 60; ++n) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.id));
  }
  const wanted = ["disks", "colour", "low", "high", "trails", "arrows", "images", "smooth", "dark", "disk", "link", "picture",
    "play", "back", "on", "frame", "speed", "loop", "closer", "farther", "fit"];
  assert.deepEqual(wanted.filter((id) => !reached.has(id)), []);
  const named = await page.evaluate(() => [...document.querySelectorAll("button, input, select, canvas[role]")]
    .filter((control) => !(control.getAttribute("aria-label") || control.textContent || control.closest("label")?.textContent.trim())).map((control) => control.id));
  assert.deepEqual(named, [], "every control has a name for screen readers");
  await page.focus("#disks");
  const frame = () => page.evaluate(() => window.carom.playback.frame);
  await page.keyboard.press("ArrowRight");
  assert.equal(await frame(), 1);
  await page.keyboard.press("Shift+ArrowRight");
  assert.equal(await frame(), 11);
  await page.keyboard.press("ArrowLeft");
  assert.equal(await frame(), 10);
  await page.keyboard.press("End");
  assert.equal(await frame(), 120);
  await page.keyboard.press("Home");
  assert.equal(await frame(), 0);
  await page.keyboard.press("Space");
  await page.waitForFunction(() => window.carom.playback.frame > 5);
  await page.keyboard.press("Space");
  const stopped = await frame();
  await page.waitForTimeout(300);
  assert.equal(await frame(), stopped);
  const scale = () => page.evaluate(() => window.carom.camera.scale);
  const fitted = await scale();
  await page.keyboard.press("+");
  assert.ok((await scale()) > fitted * 1.2);
  await page.keyboard.press("0");
  assert.equal(await scale(), fitted);
  await page.close();
});

test("plots in time have a cursor that a click moves, those of the whole run have none", async () => {
  const scene = restScene().replace("[output]", '[analysis]\nwhat = ["pair_correlation"]\nevery = 0.5\n[output]\nseries = true');
  shop.run("plotted", scene);
  const { page, errors } = await shop.show(shop.view("plotted").file);
  await drawn(page, 0);
  assert.deepEqual(await page.evaluate(() => window.carom.plots.rows().map(({ name }) => name)), ["kinetic", "pressure", "g(r)"]);
  const click = async (part, y) => {
    const { width } = await page.locator("#plot").boundingBox();
    await page.locator("#plot").click({ position: { x: part * width, y } });
    return page.evaluate(() => window.carom.playback.time);
  };
  assert.ok(Math.abs((await click(0.5, 40)) - 1) < 0.05);
  assert.ok(Math.abs((await click(0.25, 40 + 92)) - 0.5) < 0.05);
  assert.ok(Math.abs((await click(0.75, 40 + 184)) - 0.5) < 0.05, "g(r) is not against time");
  assert.match(await page.textContent("#plot-values"), /^kinetic 0\.5, pressure/);
  assert.deepEqual(errors, []);
  await page.close();
});

test("a link leads to its moment and its disk", async () => {
  const { page } = await shop.show(openPage, "#t=10.1&disk=41");
  await drawn(page, 40);
  assert.equal(await page.inputValue("#disk"), "41");
  await page.click("#link");
  assert.match(page.url(), /#t=10\.1&disk=41$/);
  await page.close();
});

test("title and group names of a hostile scene run no script", async () => {
  const hostile = `</script><script>window.hurt = 1</script><img src=x onerror="window.hurt = 2"><!--`;
  shop.run("hostile", restScene(hostile).replace("count = 4", `name = "evil"\ncount = 4`));
  const { page, errors } = await shop.show(shop.view("hostile").file);
  assert.equal(await page.evaluate(() => window.hurt), undefined);
  assert.equal(await page.textContent("#title"), hostile);
  assert.equal(await page.title(), hostile);
  assert.equal(await page.locator("img").count(), 0);
  // And if markup came in by another way, the policy would stop it.
  await page.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "window.hurt = 3";
    document.body.append(script);
  });
  assert.equal(await page.evaluate(() => window.hurt), undefined);
  assert.deepEqual(errors, []);
  await page.close();
});

test("a file that breaks off says from which frame on, and shows what comes before", async () => {
  const text = readFileSync(openPage, "latin1");
  const cut = shop.path("cut.html");
  writeFileSync(cut, text.slice(0, text.indexOf('id="block1"') + 200), "latin1");
  const { page } = await shop.show(cut);
  assert.equal(await page.textContent("#message"), "This file is incomplete: frames 65 to 121 are missing, and all that follow.");
  await drawn(page, 0);
  await page.keyboard.press("End");
  await page.waitForFunction(() => document.getElementById("message").textContent.includes("damaged"));
  assert.equal(await page.textContent("#message"), "Frames 65 to 121 are damaged: the file breaks off there.");
  await page.close();
  for (const mark of ['id="head"', 'id="table"', "<main>"]) {
    writeFileSync(cut, text.slice(0, text.indexOf(mark) + 30), "latin1");
    const said = await shop.browser.newPage();
    await said.goto(`file://${cut}`);
    await said.waitForFunction(() => document.body.innerText.includes("incomplete"));
    await said.close();
  }
});

test("a changed letter is found, and named with its frames", async () => {
  const text = readFileSync(openPage, "latin1");
  for (const [letter, what] of [["A", "their checksum is another"], ["!", "there are letters that do not belong there"]]) {
    const at = text.indexOf('id="block1"') + 400;
    const flipped = shop.path("flipped.html");
    const other = letter === "A" && text[at] === "A" ? "B" : letter;
    writeFileSync(flipped, text.slice(0, at) + other + text.slice(at + 1), "latin1");
    const { page } = await shop.show(flipped, "#t=29");
    await page.waitForFunction(() => !document.getElementById("message").hidden);
    assert.equal(await page.textContent("#message"), `Frames 65 to 121 are damaged: ${what}.`);
    await page.keyboard.press("Home");
    await drawn(page, 0);
    await page.close();
  }
});

test("--max-size is kept, and the page and the terminal say what is left out", async () => {
  shop.run("long", openScene.replace("every = 0.25", "every = 0.02"));
  const most = Math.round(0.7 * statSync(shop.view("long").file).size);
  const { file, err } = shop.view("long", "--max-size", String(most));
  assert.ok(statSync(file).size <= most);
  const sentence = /the page (shows every \w+ frame of 1501)/.exec(err)?.[1];
  assert.ok(sentence, err);
  const { page } = await shop.show(file);
  assert.ok((await page.textContent("#left-out")).includes(sentence));
  await page.close();
});
