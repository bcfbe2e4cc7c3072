// One page without anything from outside. ?frame=NAME&mode=slider|side|difference|heat opens one frame; every
// picture that was loaded gets its size as data-loaded, so that a test in a browser can see that it is there.
#include "viewer/golden/report_page.h"

namespace viewer {

const std::string_view kReportPage = R"html(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Vitrine: golden images</title>
<style>
:root { color-scheme: light dark; --bg: #f4f5f7; --card: #fff; --ink: #1d222b; --soft: #66707f; --line: #dde1e7;
  --bad: #c0342b; --good: #2c7a4b; --near: #9a6a00; --accent: #2f6fb5; }
@media (prefers-color-scheme: dark) { :root { --bg: #15181d; --card: #1e232a; --ink: #e6e9ee; --soft: #98a2b1;
  --line: #323943; --bad: #ff7a6e; --good: #63c88d; --near: #e3b341; --accent: #7db4f0; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--bg); color: var(--ink); font: 15px/1.5 system-ui, sans-serif; }
header, main { max-width: 1180px; margin: 0 auto; padding: 20px 24px; }
h1 { font-size: 22px; margin: 0 0 4px; }
h2 { font-size: 17px; margin: 0; font-weight: 600; }
.soft { color: var(--soft); }
.counts { display: flex; gap: 22px; margin: 14px 0; flex-wrap: wrap; }
.counts b { font-size: 26px; display: block; line-height: 1.1; }
.bad { color: var(--bad); } .good { color: var(--good); } .near { color: var(--near); }
.note { border-left: 4px solid var(--near); padding: 6px 12px; background: var(--card); margin: 8px 0; }
nav button, .modes button { font: inherit; border: 1px solid var(--line); background: var(--card); color: var(--ink);
  padding: 4px 12px; border-radius: 6px; cursor: pointer; }
button[aria-pressed=true] { border-color: var(--accent); color: var(--accent); font-weight: 600; }
article { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 16px 18px; margin: 0 0 18px; }
article.fail { border-left: 5px solid var(--bad); }
article.near { border-left: 5px solid var(--near); color: inherit; }
.row { display: flex; gap: 12px; align-items: baseline; flex-wrap: wrap; justify-content: space-between; }
.badge { font-size: 13px; font-weight: 600; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(140px, 1fr)); gap: 4px 18px; margin: 10px 0; font-size: 13px; }
.figures span { color: var(--soft); display: block; }
.figures code { font-size: 13px; }
.modes { display: flex; gap: 6px; margin: 8px 0; }
.stage { position: relative; width: fit-content; max-width: 100%; background: #0008; }
.stage img, .side img { display: block; max-width: 100%; }
.stage .over { position: absolute; inset: 0; }
.stage .bar { position: absolute; top: 0; bottom: 0; width: 2px; background: #fff; box-shadow: 0 0 0 1px #0006; pointer-events: none; }
.stage .tag { position: absolute; top: 8px; padding: 1px 8px; background: #000a; color: #fff; font-size: 12px; border-radius: 4px; }
.stage .worst { position: absolute; border: 2px solid #ff3b2f; border-radius: 3px; pointer-events: none; }
.side { display: grid; grid-template-columns: 1fr 1fr; gap: 8px; }
input[type=range] { width: 100%; max-width: 640px; margin: 6px 0 0; accent-color: var(--accent); }
#same { display: grid; grid-template-columns: repeat(auto-fill, minmax(250px, 1fr)); gap: 14px; }
#same figure { margin: 0; background: var(--card); border: 1px solid var(--line); border-radius: 8px; overflow: hidden; }
#same img { width: 100%; display: block; }
#same figcaption { padding: 6px 10px; font-size: 13px; }
</style>
</head>
<body>
<header>
<h1>Golden images</h1>
<div class="soft" id="head"></div>
<div class="counts" id="counts"></div>
<div id="notes"></div>
</header>
<main>
<section id="changed"></section>
<section id="unchanged"><h2 style="margin: 22px 0 12px">Unchanged, pixel for pixel</h2><div id="same"></div></section>
</main>
<script type="application/json" id="data">@DATA@</script>
<script>
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const query = new URLSearchParams(location.search);
const make = (tag, attributes = {}, ...children) => {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
};
const picture = (source, text, lazy) => {
  const image = make("img", {alt: text});
  image.onload = () => { image.dataset.loaded = image.naturalWidth + "x" + image.naturalHeight; };
  if (lazy) image.loading = "lazy";
  image.src = source;
  return image;
};
const short = (value) => Number(value.toPrecision(3)).toString();

const worstBlock = (frame, image, stage) => {
  const mark = make("div", {class: "worst"});
  const place = () => {
    const scale = image.clientWidth / image.naturalWidth, edge = 14;
    mark.style.left = (frame.worst[0] - edge / 2) * scale + "px";
    mark.style.top = (frame.worst[1] - edge / 2) * scale + "px";
    mark.style.width = mark.style.height = (8 + edge) * scale + "px";
  };
  image.addEventListener("load", place);
  addEventListener("resize", place);
  stage.append(mark);
};

const modes = {
  slider: (frame) => {
    const stage = make("div", {class: "stage"});
    const expected = picture(frame.expected, "expected");
    const actual = picture(frame.actual, "actual");
    actual.className = "over";
    const bar = make("div", {class: "bar"});
    const range = make("input", {type: "range", min: 0, max: 100, step: 0.5, "aria-label": "expected or actual"});
    const left = make("div", {class: "tag", style: "left: 8px"}, "expected");
    const right = make("div", {class: "tag", style: "right: 8px"}, "actual");
    const set = (percent) => {
      range.value = percent;
      actual.style.clipPath = `inset(0 0 0 ${percent}%)`;
      bar.style.left = percent + "%";
    };
    range.oninput = () => set(range.value);
    stage.onpointermove = (event) => {
      const box = stage.getBoundingClientRect();
      set(100 * Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)));
    };
    stage.append(expected, actual, bar, left, right);
    worstBlock(frame, expected, stage);
    set(query.get("slider") || 50);
    return make("div", {}, stage, range);
  },
  side: (frame) => make("div", {class: "side"}, make("div", {}, "expected", picture(frame.expected, "expected")),
                        make("div", {}, "actual", picture(frame.actual, "actual"))),
  difference: (frame) => make("div", {}, picture(frame.difference, "difference"),
                              make("div", {class: "soft"}, "distance of each pixel, 8 times amplified")),
  heat: (frame) => make("div", {}, picture(frame.heat, "heat map"),
                        make("div", {class: "soft"}, "FLIP: black same, white most different to the eye")),
};
const labels = {slider: "Slider", side: "Side by side", difference: "Difference", heat: "Heat map"};

const figure = (name, value) => make("div", {}, make("span", {}, name), make("code", {}, value));
const figures = (frame) => {
  const box = make("div", {class: "figures"});
  if (frame.expected && frame.actual) {
    box.append(figure("largest channel difference", frame.max_channel + " levels"));
    box.append(figure("pixels visibly different", frame.pixels_over));
    box.append(figure("worst 8x8 block", short(frame.max_block) + " levels at " + frame.worst.join(", ")));
    if (frame.mean_flip !== undefined)
      box.append(figure("FLIP mean / worst block", short(frame.mean_flip) + " / " + short(frame.max_block_flip)));
  }
  if (frame.state_actual)
    box.append(figure("state hash", frame.state_actual + (!frame.state_expected ? "" :
      frame.state_expected === frame.state_actual ? " (as golden)" : " (golden " + frame.state_expected + ")")));
  if (frame.tolerance) box.append(figure("own tolerance", frame.tolerance));
  return box;
};

const card = (frame) => {
  const article = make("article", {class: frame.pass ? "near" : "fail", "data-name": frame.name, id: frame.name});
  article.append(make("div", {class: "row"}, make("h2", {}, frame.name),
    make("span", {class: "badge " + (frame.pass ? "near" : "bad")}, frame.pass ? "passes" : frame.triage)));
  article.append(make("div", {class: "soft"}, frame.why), figures(frame));
  if (!frame.expected || !frame.actual) {
    const only = frame.actual || frame.expected;
    if (only) article.append(make("div", {class: "soft"}, frame.actual ? "actual" : "expected"), picture(only, frame.actual ? "actual" : "expected"));
    return article;
  }
  const view = make("div", {class: "view"});
  const bar = make("div", {class: "modes"});
  const show = (mode) => {
    for (const button of bar.children) button.setAttribute("aria-pressed", button.dataset.mode === mode);
    view.dataset.mode = mode;
    view.replaceChildren(modes[mode](frame));
  };
  for (const mode of Object.keys(modes)) {
    if (modes[mode] && (frame[mode] !== "" || mode === "slider" || mode === "side")) {
      const button = make("button", {type: "button", "data-mode": mode}, labels[mode]);
      button.onclick = () => show(mode);
      bar.append(button);
    }
  }
  article.append(bar, view);
  const asked = query.get("mode");
  show(asked in modes && frame[asked] !== "" ? asked : "slider");
  return article;
};

const count = (test) => data.frames.filter(test).length;
const add = (number, text, kind) =>
  document.getElementById("counts").append(make("div", {class: kind}, make("b", {}, number), text));
const failed = count((f) => !f.pass), exact = count((f) => f.pass && f.exact), near = count((f) => f.pass && !f.exact);
add(failed, "failed", failed ? "bad" : "soft");
add(near, "pass within limits", near ? "near" : "soft");
add(exact, "pixel for pixel", "good");
document.getElementById("head").textContent =
  `${data.frames.length} frames in ${data.seconds.toFixed(1)} s, drawn by ${data.renderer}`;
const other = count((f) => !f.same_rasteriser);
if (other) document.getElementById("notes").append(make("div", {class: "note"},
  `${other} golden images were drawn by another rasteriser: the looser rule (FLIP of the worst block) decided about them.`));
const only = query.get("frame");
for (const frame of data.frames) {
  if (only && frame.name !== only) continue;
  if (frame.pass && frame.exact && !only) {
    document.getElementById("same").append(make("figure", {"data-name": frame.name},
      picture(frame.actual, frame.name, true), make("figcaption", {}, frame.name)));
  } else {
    document.getElementById("changed").append(card(frame));
  }
}
if (!document.getElementById("same").children.length) document.getElementById("unchanged").remove();
document.body.dataset.failed = failed;
document.body.dataset.ready = "true";
</script>
</body>
</html>
)html";

}  // namespace viewer
