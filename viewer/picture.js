// Pictures of the page, as files.

// The canvases on top of each other, as a PNG.
export function pictureOf(...layers) {
  const all = document.createElement("canvas");
  all.width = layers[0].width;
  all.height = layers[0].height;
  for (const layer of layers) all.getContext("2d").drawImage(layer, 0, 0);
  return new Promise((done) => all.toBlob(done, "image/png"));
}

export function saveAs(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
