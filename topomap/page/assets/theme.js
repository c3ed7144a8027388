// The colours of what is drawn, for light and dark, and the marks of the types.

const LIGHT = {
  outside: "#e3e6ea", free: "#ffffff", wall: "#3a424d", grid: "#eef0f3", ink: "#1d232b",
  soft: "#5d6773", edge: "#4a525d", region: "rgba(178,24,43,.13)", rim: "rgba(178,24,43,.45)",
  open: "#1b7837", ray: "rgba(217,119,6,.75)", lost: "#b2182b", halo: "#ffffff", line: "#d9dde3",
  good: "#1b7837", card: "#ffffff",
  types: { INT: "#2166ac", EXT: "#d6604d", ILL: "#8a8f96", PORTAL: "#1b7837", SPLIT: "#762a83", TERM: "#222222" },
  many: ["#2166ac", "#c2410c", "#1b7837", "#762a83", "#b8860b", "#0f766e", "#be185d", "#4b5563"],
};
const DARK = {
  outside: "#0f1216", free: "#20262e", wall: "#8d99a8", grid: "#272e37", ink: "#e4e8ee",
  soft: "#98a3b0", edge: "#aab4c0", region: "rgba(240,138,138,.16)", rim: "rgba(240,138,138,.5)",
  open: "#6cc287", ray: "rgba(251,191,36,.8)", lost: "#f08a8a", halo: "#14181d", line: "#323a45",
  good: "#6cc287", card: "#1c2128",
  types: { INT: "#6aa9ee", EXT: "#f4937f", ILL: "#9aa3ad", PORTAL: "#6cc287", SPLIT: "#c79be0", TERM: "#dddddd" },
  many: ["#6aa9ee", "#fb923c", "#6cc287", "#c79be0", "#e3c04f", "#4fd1c5", "#f472b6", "#a3adb9"],
};

const MEANING = {
  INT: "inner corner",
  EXT: "outer corner",
  ILL: "ill-defined corner",
  PORTAL: "portal to a hall",
  SPLIT: "mouth of a hall",
  TERM: "end of a hall",
};

function isDark() {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
}

const colours = () => (isDark() ? DARK : LIGHT);
const colourOf = (palette, number) => palette.many[number % palette.many.length];

// Add the mark of a type to a path: a shape of its own, not a colour alone.
function addMark(path, type, x, y, r) {
  if (type === "EXT") path.rect(x - r * 0.9, y - r * 0.9, 1.8 * r, 1.8 * r);
  else if (type === "PORTAL") polygon(path, [x, y - 1.25 * r, x + 1.25 * r, y, x, y + 1.25 * r, x - 1.25 * r, y]);
  else if (type === "SPLIT") polygon(path, [x, y - 1.15 * r, x + 1.1 * r, y + 0.85 * r, x - 1.1 * r, y + 0.85 * r]);
  else if (type === "TERM") polygon(path, [x, y + 1.15 * r, x + 1.1 * r, y - 0.85 * r, x - 1.1 * r, y - 0.85 * r]);
  else if (type === "ILL") polygon(path, [x, y - r * 0.35, x + r * 0.7, y - r, x + r, y - r * 0.7, x + r * 0.35, y, x + r, y + r * 0.7, x + r * 0.7, y + r, x, y + r * 0.35, x - r * 0.7, y + r, x - r, y + r * 0.7, x - r * 0.35, y, x - r, y - r * 0.7, x - r * 0.7, y - r]);
  else {
    path.moveTo(x + r, y);
    path.arc(x, y, r, 0, 2 * Math.PI);
  }
}

function polygon(path, corners) {
  path.moveTo(corners[0], corners[1]);
  for (let k = 2; k < corners.length; k += 2) path.lineTo(corners[k], corners[k + 1]);
  path.closePath();
}
