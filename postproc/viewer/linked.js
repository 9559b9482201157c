// Several views on one page: one camera, one set of controls, one scale of colours, of forces and of displacements.

function linkViewers(viewers) {
  linkCameras(viewers);
  linkControls(viewers);
  const most = Math.min(...viewers.map((viewer) => viewer.mostMagnified));
  for (const viewer of viewers) if (viewer.mostMagnified < Infinity) viewer.limitMagnification(most);
  const scales = viewers.map((viewer) => viewer.model.forceScale).filter((scale) => scale > 0);
  for (const viewer of viewers) {
    for (const part of [".picture", ".numbers"]) viewer.find(part).dataset.label = viewer.host.dataset.label;
    viewer.colouring.peers = viewers.map((peer) => peer.colouring);
    if (scales.length) viewer.model.forceScale = Math.min(...scales);
  }
  for (const viewer of viewers) viewer.setColour("bond");
}

function linkCameras(viewers) {
  let leader = null;
  for (const from of viewers)
    from.stage.controls.addEventListener("change", () => {
      if (leader) return;
      leader = from;
      for (const to of viewers) if (to !== from) to.stage.follow(from.stage);
      leader = null;
    });
}

/** What is set in one view is set in the others, as far as they have it. Sliders pass on their place between their ends. */
function linkControls(viewers) {
  const pass = (event, from) => {
    const {target, type} = event, selector = target.name ? `[name=${target.name}]` : "." + target.className;
    for (const to of viewers) {
      const twin = to === from ? null : to.find(selector);
      if (!twin) continue;
      if (target.type === "checkbox") twin.checked = target.checked;
      else if (target.type === "range") twin.value = Number(twin.min) + (target.value - target.min) / (target.max - target.min) * (twin.max - twin.min);
      else if (Array.from(twin.options).some((option) => option.value === target.value)) twin.value = target.value;
      else continue;
      twin.dispatchEvent(new Event(type));  // does not bubble, so that it is not passed on
    }
  };
  for (const from of viewers) for (const type of ["input", "change"]) from.host.addEventListener(type, (event) => pass(event, from));
}
