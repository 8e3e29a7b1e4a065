// Additions for the page of a run that is going on (carom view --live): it asks its server for blocks and news.
window.caromLive = {
  texts: new Map(), // of blocks, by id: they are kept when the server is gone

  textOf(id) {
    if (id.startsWith("block") && !this.texts.has(id))
      this.texts.set(
        id,
        this.get(id).catch(() => null),
      );
    return this.texts.get(id) ?? null;
  },

  async get(path) {
    const answer = await fetch(path, { cache: "no-store" });
    if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
    return answer.text();
  },

  async follow(viewer, tellStory) {
    this.tellStory = tellStory;
    document.getElementById("loop").click();
    viewer.jump(viewer.playback.last);
    viewer.store.blocks.forEach((_, k) => this.textOf(`block${k}`));
    for (let ended = false; !ended;) {
      try {
        const news = JSON.parse(await this.get(`news/${viewer.store.blocks.length}/${viewer.head.disks}`));
        this.grow(viewer, news);
        this.say(news.ended ? `${news.state} This page keeps what it has.` : news.state);
        ended = news.ended;
      } catch {
        this.say("The run cannot be followed any longer. This page keeps what it has.");
        return;
      }
      await new Promise((done) => setTimeout(done, 500));
    }
  },

  say(sentence) {
    const line = document.getElementById("left-out");
    if (line.textContent !== sentence) line.textContent = sentence;
  },

  grow(viewer, news) {
    const { head, store, playback } = viewer;
    const first = store.blocks.length;
    if (news.blocks.length) {
      this.addDisks(viewer, news);
      store.addBlocks(news.blocks);
      for (let k = first; k < store.blocks.length; ++k) this.textOf(`block${k}`);
      this.addFrames(viewer, news.times);
      if (head.fast !== news.fast && !viewer.rangeChosen) viewer.range = null;
      head.fast = news.fast;
      head.insets.forEach((inset, side) => inset?.push(...news.insets[side]));
      head.shifts.forEach((shift, wall) => shift?.push(...news.shifts[wall]));
      this.tellStory(head);
    }
    viewer.plots.setSeries(news.series);
    playback.setTimes(store.times);
    viewer.dirty = true;
  },

  join(old, fresh) {
    const all = new old.constructor(old.length + fresh.length);
    all.set(old);
    all.set(fresh, old.length);
    return all;
  },

  addDisks(viewer, news) {
    const { head, store } = viewer;
    const known = new Set(store.group);
    store.id = this.join(store.id, news.id);
    store.radius = this.join(store.radius, news.radius);
    store.mass = this.join(store.mass, news.mass);
    store.group = this.join(store.group, news.group);
    store.largest = news.radius.reduce((a, b) => Math.max(a, b), store.largest);
    head.disks = store.id.length;
    if (news.group.every((group) => known.has(group))) return;
    head.grouped = store.group.some((group) => group !== store.group[0]);
    const { options } = document.getElementById("colour");
    if (head.grouped && ![...options].some(({ value }) => value === "group"))
      options.add(new window.Option("group"), 1);
    if (viewer.colour === "group") viewer.range = null; // so that the list of groups is made again
  },

  // Adds new frames. A page at its last frame goes on to the new ones, unless it is being played.
  addFrames(viewer, times) {
    const { head, store, playback } = viewer;
    const last = playback.last;
    const follows = playback.frame === last && !playback.playing;
    store.times = this.join(store.times, times);
    head.frames = store.times.length;
    playback.setTimes(store.times);
    document.getElementById("frame").max = playback.last;
    // So far the last frame had the steps of the one before it.
    viewer.renderer.forget();
    viewer.drawn = -1;
    if (follows) viewer.jump(playback.last);
  },
};
