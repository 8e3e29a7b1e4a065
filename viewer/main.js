// Reads the data of the page and shows them, or says why that is impossible.
import { counted, element } from "./format.js";
import { Store } from "./store.js";
import { Viewer } from "./viewer.js";

// Describes the run in the line beside its title.
function tellStory({ disks, frames, version }) {
  element("story").textContent = `${counted(disks, "disk")}, ${counted(frames, "frame")}, carom ${version}`;
}

async function begin() {
  const fail = (message) => {
    element("message").textContent = message;
    element("message").hidden = false;
  };
  let head;
  try {
    head = JSON.parse(element("head").textContent);
  } catch {
    fail("This file is incomplete: it breaks off before its first frame.");
    return;
  }
  element("title").textContent = head.title || "a run";
  tellStory(head);
  if (head.leftOut.length) {
    element("left-out").textContent = `This page ${head.leftOut.join(", and ")}.`;
    element("left-out").hidden = false;
  }
  try {
    const store = new Store(head);
    const missing = store.missing();
    await store.readTable().catch((error) => {
      throw new Error(missing || `The table of disks is damaged: ${error.message}.`);
    });
    const viewer = new Viewer(store);
    viewer.start();
    if (missing) viewer.say(missing);
    window.carom = viewer;
    window.caromLive?.follow(viewer, tellStory);
  } catch (error) {
    fail(error.message);
  }
}
document.addEventListener("DOMContentLoaded", begin);
