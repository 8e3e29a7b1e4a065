// The page made by carom view, in a real browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { drawn, framesOf, restScene, Workshop } from "./view_support.mjs";

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

let open; // the run used by openScene
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
  assert.ok(
    frames.some((frame, k) => k > 0 && frame.disks.size !== frames[k - 1].disks.size),
    "disks come and go",
  );
  frames.forEach(({ time, disks }, k) => {
    assert.equal(shown.times[k], time);
    const { id, x, y } = shown.all[k];
    assert.deepEqual(
      [...id].sort((a, b) => a - b),
      [...disks.keys()],
    );
    id.forEach((which, i) => {
      const disk = disks.get(which);
      const dy = Math.abs(y[i] - disk.y);
      assert.ok(Math.abs(x[i] - disk.x) <= shown.quanta[0] * 0.5000001, `x of disk ${which} in frame ${k}`);
      assert.ok(Math.min(dy, 12 - dy) <= shown.quanta[1] * 0.5000001, `y of disk ${which} in frame ${k}`);
    });
  });
  const sizes = new Map(frames.flatMap(({ disks }) => [...disks]));
  for (const [id, radius, mass] of shown.table)
    assert.deepEqual([radius, mass], [sizes.get(id).radius, sizes.get(id).mass]);
  assert.deepEqual(errors, []);
  assert.deepEqual(
    requests.filter((url) => !/^(file|blob):/.test(url)),
    [],
    "the network is not asked for anything",
  );
  await page.close();
});

test("the page may not ask the network either", async () => {
  const { page } = await shop.show(openPage);
  const refused = await page.evaluate(() =>
    fetch("http://127.0.0.1:9/").then(
      () => "answered",
      (error) => error.name,
    ),
  );
  assert.equal(refused, "TypeError");
  const policy = await page.evaluate(() => document.querySelector("meta[http-equiv]").content);
  assert.match(policy, /^default-src 'none'; script-src 'sha256-/);
  await page.close();
});

test("colours, trails, arrows, images and both themes draw something else, without an error", async () => {
  const { page, errors } = await shop.show(openPage, "#t=5");
  await drawn(page, 20);
  const picture = () =>
    page.evaluate(async () =>
      Array.from(new Uint8Array(await (await window.carom.takePicture()).arrayBuffer())).join(),
    );
  let last = await picture();
  for (const colour of ["group", "radius", "mass", "id", "coordination", "fixed", "speed"]) {
    await page.selectOption("#colour", colour);
    await drawn(page, 20);
    if (colour === "coordination")
      await page.waitForFunction(() => window.carom.counts.get(20)?.some((count) => count > 0));
    const now = await picture();
    assert.notEqual(now, last, colour);
    last = now;
  }
  assert.equal(await page.locator("#groups li").count(), 0);
  await page.selectOption("#colour", "group");
  await drawn(page, 20);
  assert.deepEqual(await page.locator("#groups li").allTextContents(), ["group 0", "heavy", "sources"]);
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

test("the keyboard alone reaches every control and plays the run", async () => {
  const { page } = await shop.show(openPage);
  const reached = new Set();
  for (let n = 0; n < 60; ++n) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.id));
  }
  const wanted = [
    "disks",
    "colour",
    "low",
    "high",
    "trails",
    "arrows",
    "images",
    "smooth",
    "dark",
    "disk",
    "link",
    "picture",
    "play",
    "back",
    "on",
    "frame",
    "speed",
    "loop",
    "closer",
    "farther",
    "fit",
  ];
  assert.deepEqual(
    wanted.filter((id) => !reached.has(id)),
    [],
  );
  const named = await page.evaluate(() =>
    [...document.querySelectorAll("button, input, select, canvas[role]")]
      .filter(
        (control) =>
          !(control.getAttribute("aria-label") || control.textContent || control.closest("label")?.textContent.trim()),
      )
      .map((control) => control.id),
  );
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
  const scene = restScene().replace(
    "[output]",
    '[analysis]\nwhat = ["pair_correlation"]\nevery = 0.5\n[output]\nseries = true',
  );
  shop.run("plotted", scene);
  const { page, errors } = await shop.show(shop.view("plotted").file);
  await drawn(page, 0);
  assert.deepEqual(await page.evaluate(() => window.carom.plots.rows().map(({ name }) => name)), [
    "kinetic",
    "pressure",
    "g(r)",
  ]);
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

test("a link leads to its own frame, whatever the digits of its time, and so do links of eight digits", async () => {
  // Frame times are 1234567.1234567 times k: rounding to eight digits makes some smaller and others larger.
  shop.run(
    "digits",
    restScene().replace("t_end = 2.0", "t_end = 2e7").replace("every = 0.5", "every = 1234567.1234567"),
  );
  const { file } = shop.view("digits");
  const { page } = await shop.show(file);
  const { links, opened, rounded, times } = await page.evaluate(async () => {
    const viewer = window.carom;
    const found = { links: [], opened: [], rounded: [], times: [...viewer.store.times] };
    const follow = (hash) => {
      viewer.jump(0);
      history.replaceState(null, "", hash);
      viewer.followHash();
      return viewer.playback.frame;
    };
    for (let k = 0; k < viewer.head.frames; ++k) {
      viewer.jump(k);
      viewer.takeLink();
      found.links.push(location.hash);
      found.opened.push(follow(location.hash));
      found.rounded.push(follow(`#t=${Number(viewer.store.times[k].toPrecision(8))}`));
    }
    return found;
  });
  const frames = times.map((_, k) => k);
  assert.deepEqual(opened, frames);
  assert.deepEqual(rounded, frames, "links of eight digits");
  assert.deepEqual(
    links.map((link) => Number(link.slice(3))),
    times,
    "the whole time",
  );
  await page.close();
  const { page: another } = await shop.show(file, links[3]);
  await drawn(another, 3);
  await another.close();
});

test("title and group names of a hostile scene run no script", async () => {
  const hostile = `</script><script>window.hurt = 1</script><img src=x onerror="window.hurt = 2"><!--`;
  shop.run("hostile", restScene(hostile).replace("count = 4", `name = "evil"\ncount = 4`));
  const { page, errors } = await shop.show(shop.view("hostile").file);
  assert.equal(await page.evaluate(() => window.hurt), undefined);
  assert.equal(await page.textContent("#title"), hostile);
  assert.equal(await page.title(), hostile);
  assert.equal(await page.locator("img").count(), 0);
  // If markup came in by another way, the policy would still stop it.
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
  assert.equal(
    await page.textContent("#message"),
    "This file is incomplete: frames 65 to 121 are missing, and all that follow.",
  );
  await drawn(page, 0);
  await page.keyboard.press("End");
  await page.waitForFunction(() => document.getElementById("message").textContent.includes("damaged"));
  assert.equal(await page.textContent("#message"), "Frames 65 to 121 are damaged: the file ends too early.");
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
  for (const [letter, what] of [
    ["A", "the checksum is wrong"],
    ["!", "a letter is not base64"],
  ]) {
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
