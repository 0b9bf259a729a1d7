// SPDX-License-Identifier: Apache-2.0
// Every word of the page, in each of its languages. `hint` says what a word means.

import { signal } from "@preact/signals";

export type Language = "en" | "uk";

const EN = {
  title: "Obvid studio",
  open: "Open", openHint: "Points, a contour, DXF, SVG, GPX, ... from a file; or drop it here, or paste points",
  save: "Export", copyPoints: "Copy points", copied: "Copied",
  undo: "Undo", redo: "Redo", fit: "Fit view", theme: "Dark or light", language: "Українська",
  computing: "computing ...", proved: "proved", notProved: "not proved", none: "no contour",
  unreachable: "the engine does not answer", greyed: "the last contour that was found, greyed",
  vertices: "vertices", verticesHint: "places where the curvature stops growing or falling",
  forced: "at least {n} unless a curve winds between the points",
  inflections: "inflections", inflectionsHint: "places where the curve bends the other way",
  error: "largest error", errorHint: "no monotone curve with these tangents and curvatures at the points is farther from this one",
  gaps: "joint gaps", waviness: "waviness", wavinessHint: "hills of the slope of curvature on a run; one is the best",
  time: "time", pieces: "pieces",
  carrier: "Curve family", carrierHint: "what the contour is made of",
  continuity: "Joints", continuityHint: "G2: curvature goes on; G3: its slope too, no kinks in the plot",
  noise: "Noise", noiseHint: "how far each point may be moved; empty: met exactly",
  tolerance: "Tolerance", toleranceHint: "how narrow the region is made; empty: 3e-6 of the size",
  closing: "Ends", auto: "by the points", closed: "closed", openEnds: "open",
  convex: "Convex", convexHint: "one way of turning, no inflection",
  primitives: "Lines and arcs", primitivesHint: "those among noisy points stay lines and arcs",
  corners: "Find corners",
  units: "Unit",
  point: "Point", heading: "Heading, °", headingHint: "direction of the contour, counter-clockwise from x",
  radius: "Radius", radiusHint: "positive where the contour turns left; inf: straight",
  corner: "Corner", cornerHint: "the contour turns here at once",
  feasible: "possible", remove: "Remove", noSelection: "Select a point: click it, or Tab. Double click adds one.",
  segments: "Segments", compare: "Compare", noiseTab: "Noise and vertices", points: "Points",
  chord: "chord", pointsOnly: "from points alone", own: "with its tangents",
  family: "family",
  suggestHint: "how many vertices which noise needs; click a row to take it",
  comb: "Comb", curvature: "curvature", slope: "slope of curvature", radiusPlot: "radius",
  shadeRegion: "Region", shadeRegionHint: "where every monotone curve with these points, tangents and curvatures runs; its width is magnified by the factor beside it",
  keep: "Keep to compare", keepHint: "the contour as it is stays in grey; how far the next one goes from it is measured", apart: "apart",
  picture: "Picture", setScale: "Set scale", setScaleHint: "click two places of the picture, then type how far apart they are", clickTwo: "click two places", howFar: "how far apart",
  snap: "Snap", snapHint: "points that are dragged move in tenths of the grid",
  combScale: "Height of the comb", arcLength: "arc length",
  whyNot: "Why not?", whyNotHint: "what stands in the way, and what would do",
  tour: ["Drag a point: the contour follows and is proved again.", "Teeth show the curvature: they grow or shrink without waves.",
    "Select a point to give it a heading or a radius; the arc and the bar show what is possible.", "The line at the top says what is proved, and what is not."],
  next: "Next", done: "Done",
  inPage: "Computed within this page; nothing leaves it. STEP, IGES and BREP files are opened by the program obvid on your machine.",
  needsProgram: "STEP, IGES and BREP are not opened here; form the contour with: obvid fit {file}",
};

type Words = typeof EN;

const UK: Words = {
  title: "Студія Обвід",
  open: "Відкрити", openHint: "Точки, контур, DXF, SVG, GPX, ... з файлу; або перетягніть його сюди, або вставте точки",
  save: "Зберегти як", copyPoints: "Копіювати точки", copied: "Скопійовано",
  undo: "Скасувати", redo: "Повторити", fit: "Показати все", theme: "Темна чи світла", language: "English",
  computing: "обчислення ...", proved: "доведено", notProved: "не доведено", none: "обводу немає",
  unreachable: "обчислювач не відповідає", greyed: "останній знайдений обвід, сірий",
  vertices: "вершини", verticesHint: "місця, де кривина перестає зростати чи спадати",
  forced: "щонайменше {n}, якщо крива не намотує витків між точками",
  inflections: "перегини", inflectionsHint: "місця, де крива згинається в інший бік",
  error: "найбільша похибка", errorHint: "жодна монотонна крива з цими дотичними і кривинами в точках не лежить далі від цієї",
  gaps: "розриви в стиках", waviness: "хвилястість", wavinessHint: "горби похідної кривини на ділянці; один — найкраще",
  time: "час", pieces: "частини",
  carrier: "Вид кривих", carrierHint: "з чого складено обвід",
  continuity: "Стики", continuityHint: "G2: неперервна кривина; G3: і її похідна, без зламів на графіку",
  noise: "Шум", noiseHint: "на скільки можна зсунути кожну точку; порожньо: точно через точки",
  tolerance: "Допуск", toleranceHint: "наскільки вузькою робиться область; порожньо: 3e-6 розміру",
  closing: "Кінці", auto: "за точками", closed: "замкнений", openEnds: "розімкнений",
  convex: "Опуклий", convexHint: "поворот в один бік, без перегинів",
  primitives: "Прямі й дуги", primitivesHint: "ті, що є серед точок із шумом, лишаються прямими й дугами",
  corners: "Шукати кути",
  units: "Одиниця",
  point: "Точка", heading: "Напрям, °", headingHint: "напрям обводу, проти годинникової стрілки від осі x",
  radius: "Радіус", radiusHint: "додатний, де обвід повертає ліворуч; inf: пряма",
  corner: "Кут", cornerHint: "тут обвід повертає одразу",
  feasible: "можливо", remove: "Вилучити", noSelection: "Виберіть точку: клацніть її або Tab. Подвійне клацання додає точку.",
  segments: "Відрізки", compare: "Порівняння", noiseTab: "Шум і вершини", points: "Точки",
  chord: "хорда", pointsOnly: "із самих точок", own: "з її дотичними",
  family: "вид",
  suggestHint: "скільки вершин потребує який шум; клацніть рядок, щоб узяти його",
  comb: "Гребінь", curvature: "кривина", slope: "похідна кривини", radiusPlot: "радіус",
  shadeRegion: "Область", shadeRegionHint: "де проходить кожна монотонна крива з цими точками, дотичними й кривинами; ширину збільшено в указану кількість разів",
  keep: "Лишити для порівняння", keepHint: "обвід лишається сірим; вимірюється, наскільки далеко від нього йде наступний", apart: "відстань",
  picture: "Малюнок", setScale: "Масштаб", setScaleHint: "клацніть два місця малюнка, тоді введіть, як далеко вони одне від одного", clickTwo: "клацніть два місця", howFar: "відстань між ними",
  snap: "Прив’язка", snapHint: "точки, які тягнуть, рухаються десятими частинами сітки",
  combScale: "Висота гребеня", arcLength: "довжина дуги",
  whyNot: "Чому ні?", whyNotHint: "що заважає і що допомогло б",
  tour: ["Потягніть точку: обвід іде за нею і доводиться знову.", "Зубці показують кривину: вони ростуть чи спадають без хвиль.",
    "Виберіть точку, щоб задати напрям або радіус; дуга й смуга показують, що можливо.", "Рядок угорі каже, що доведено, а що ні."],
  next: "Далі", done: "Готово",
  inPage: "Обчислено в самій сторінці; ніщо її не залишає. Файли STEP, IGES і BREP відкриває програма obvid на вашому комп’ютері.",
  needsProgram: "STEP, IGES і BREP тут не відкриваються; обвід утворить: obvid fit {file}",
};

const ALL: Record<Language, Words> = { en: EN, uk: UK };

export const language = signal<Language>(navigator.language.startsWith("uk") ? "uk" : "en");

/** The words of the language that is chosen. */
export function words(): Words {
  return ALL[language.value];
}
