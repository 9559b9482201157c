// The picture as a PNG for print, 2400 pixels wide: 20 cm at 300 dpi. Title, legend with its colours, and scales stand below it.

const kPrintWidth = 2400;

/** What is written below the picture: rows of {swatch, bar, text}, from the legends that are shown. */
function legendRows(viewer) {
  const rows = [{text: viewer.header.title, bold: true}];
  for (const selector of [".legend", ".forces-legend", ".ties-legend"]) {
    const legend = viewer.find(selector);
    if (legend.hidden || !legend.innerText.trim()) continue;
    const row = {text: legend.querySelector("b") ? legend.querySelector("b").innerText : "", swatches: []};
    const bar = legend.querySelector(".bar");
    if (bar) {
      row.colours = getComputedStyle(bar).backgroundImage.match(/rgba?\([^)]*\)/g) || [];
      row.ends = Array.from(legend.querySelectorAll(".ends span"), (end) => end.innerText);
    }
    for (const swatch of legend.querySelectorAll(".swatch"))
      row.swatches.push([getComputedStyle(swatch.querySelector("i")).backgroundColor, swatch.innerText]);
    rows.push(row);
  }
  const scale = viewer.find(".of-magnification"), frame = viewer.find(".film output").innerText;
  const drawn = scale.hidden ? viewer.header.scale : `Displacements ${scale.querySelector("output").textContent}`;
  const last = [drawn, viewer.find(".film").hidden ? "" : frame].filter(Boolean).join(", ");
  if (last) rows.push({text: last});
  return rows;
}

/** Draws one row at height y, with letters of `size` pixels. */
function drawRow(pen, row, y, size) {
  let x = size;
  const write = (text, bold) => {
    pen.font = `${bold ? "bold " : ""}${size}px sans-serif`;
    pen.fillText(text, x, y);
    x += pen.measureText(text).width + 0.8 * size;
  };
  const ink = pen.fillStyle;
  if (row.text) write(row.text, row.bold);
  if (row.colours && row.colours.length) {
    write(row.ends[0]);
    const width = 14 * size, gradient = pen.createLinearGradient(x, 0, x + width, 0), last = Math.max(1, row.colours.length - 1);
    row.colours.forEach((colour, i) => gradient.addColorStop(i / last, colour));
    pen.fillStyle = gradient, pen.fillRect(x, y - 0.8 * size, width, size);
    pen.fillStyle = ink, x += width + 0.8 * size;
    write(row.ends[row.ends.length - 1]);
  }
  for (const [colour, name] of row.swatches || []) {
    pen.fillStyle = colour, pen.fillRect(x, y - 0.8 * size, size, size);
    pen.fillStyle = ink, x += 1.3 * size;
    write(name);
  }
}

/** The canvas that is saved. */
function printedPicture(viewer) {
  const {stage} = viewer, style = getComputedStyle(viewer.host), rows = legendRows(viewer);
  stage.renderer.setPixelRatio(Math.max(kPrintWidth, stage.canvas.width) / stage.canvas.clientWidth);
  stage.renderer.setSize(stage.canvas.clientWidth, stage.canvas.clientHeight, false);
  stage.draw();
  const out = document.createElement("canvas"), pen = out.getContext("2d"), gl = stage.canvas;
  const size = Math.round(gl.width / 75), line = 1.6 * size;
  out.width = gl.width, out.height = gl.height + line * (rows.length + 0.6);
  pen.fillStyle = style.getPropertyValue("--picture"), pen.fillRect(0, 0, out.width, out.height);
  pen.drawImage(gl, 0, 0);
  pen.fillStyle = style.getPropertyValue("--ink");
  rows.forEach((row, i) => drawRow(pen, row, gl.height + line * (i + 1), size));
  stage.resize();  // back to the size of the screen
  return out;
}

function savePicture(viewer) {
  printedPicture(viewer).toBlob((blob) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob), link.download = "cupola.png";
    link.click();
    URL.revokeObjectURL(link.href);
  });
}
