#!/usr/bin/env python3
"""Shows images of the samples: as a page on disk, or as the table in the README.

gallery.py page VITRINE FOLDER    renders every sample into FOLDER and writes FOLDER/index.html
gallery.py readme README          fills the README's gallery from the approved images in screenshots/ beside it
"""
import html
import json
import pathlib
import re
import subprocess
import sys

STYLE = """body { margin: 2rem auto; max-width: 1280px; font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fafafa }
h2 { margin: 2.5rem 0 0 } h3 { margin: 1rem 0 .3rem; font-weight: 600 }
.frames { display: grid; grid-template-columns: repeat(auto-fill, minmax(380px, 1fr)); gap: 12px }
figure { margin: 0 } img { width: 100%; border-radius: 4px; display: block } figcaption { color: #666; font-size: 13px }
@media (prefers-color-scheme: dark) { body { color: #ddd; background: #181818 } figcaption { color: #999 } }"""


def title(name):
    """'2_stable' -> '2 · stable', 'card_house' -> 'card house'."""
    return re.sub(r"^(\d+)_", r"\1 · ", name).replace("_", " ")


def scene_images(folder, sample, scene):
    """The images SAMPLE/SCENE_FRAME.png of one scene as (frame, path), by frame."""
    found = []
    for path in (folder / sample).glob(f"{scene}_*.png"):
        frame = path.stem[len(scene) + 1:]
        if frame.isdigit():
            found.append((int(frame), path))
    return sorted(found)


def page(vitrine, folder):
    listing = json.loads(subprocess.run([vitrine, "list", "--json"], check=True, capture_output=True, text=True).stdout)
    folder.mkdir(parents=True, exist_ok=True)
    parts = [f"<!doctype html><meta charset=utf-8><title>Vitrine samples</title><style>{STYLE}</style><h1>Vitrine samples</h1>"]
    for number, sample in enumerate(listing, 1):
        print(f"[{number}/{len(listing)}] {sample['sample']}", flush=True)
        subprocess.run([vitrine, "render", sample["sample"], "--size", "960x540", "--out", folder], check=True,
                       stdout=subprocess.DEVNULL)
        parts.append(f"<h2>{html.escape(title(sample['sample']))}</h2>")
        for scene in sample["scenes"]:
            parts.append(f"<h3>{html.escape(title(scene['name']))}</h3><p>{html.escape(scene.get('shows', ''))}</p><div class=frames>")
            for frame, path in scene_images(folder, sample["sample"], scene["name"]):
                address = path.relative_to(folder).as_posix()
                parts.append(f'<figure><a href="{address}"><img loading=lazy src="{address}" alt=""></a>'
                             f"<figcaption>frame {frame}</figcaption></figure>")
            parts.append("</div>")
    (folder / "index.html").write_text("\n".join(parts) + "\n")


def readme(path):
    """One picture a sample: the middle approved frame of the scene with the most to see, by the size of its file."""
    cells = []
    screenshots = path.parent / "screenshots"
    samples = [p for p in screenshots.iterdir() if p.is_dir() and any(p.glob("*.png"))]
    for sample in sorted(samples, key=lambda p: (int((re.match(r"\d+", p.name) or ["999"])[0]), p.name)):
        scenes = sorted({re.sub(r"_\d+$", "", p.stem) for p in sample.glob("*.png")})
        middle = {}
        for scene in scenes:
            images = scene_images(screenshots, sample.name, scene)
            middle[scene] = images[len(images) // 2][1]
        richest = max(scenes, key=lambda scene: middle[scene].stat().st_size)
        image = middle[richest].relative_to(path.parent).as_posix()
        cells.append(f"![{title(sample.name)}, {title(richest)}]({image})<br>{title(sample.name)}")
    rows = [cells[i:i + 3] + [""] * (3 - len(cells[i:i + 3])) for i in range(0, len(cells), 3)]
    table = "\n".join(["| | | |", "|---|---|---|", *("| " + " | ".join(row) + " |" for row in rows)])
    text = path.read_text()
    new, count = re.subn(r"(<!-- gallery -->\n).*?(<!-- /gallery -->)", lambda m: m[1] + table + "\n" + m[2], text, flags=re.S)
    if count != 1:
        sys.exit(f"{path}: no place between <!-- gallery --> and <!-- /gallery -->")
    path.write_text(new)


def main():
    match sys.argv[1:]:
        case ["page", vitrine, folder]: page(vitrine, pathlib.Path(folder).resolve())
        case ["readme", path]: readme(pathlib.Path(path).resolve())
        case _: sys.exit(__doc__)


if __name__ == "__main__":
    main()
