// SPDX-License-Identifier: Apache-2.0
#include "surface_page_parts.h"

namespace obvid::exchange {

std::string_view surface_page_markup() {
  return R"html(<canvas id="view" tabindex="0" role="application" aria-roledescription="surface in space" aria-label="@TITLE@: arrow keys turn the surface, shift and arrow keys move it, plus and minus zoom"></canvas>
<svg id="over" aria-hidden="true"></svg>
<header><h1>@TITLE@</h1><p>@FACTS@</p></header>
<aside id="panel" aria-label="Display">
<fieldset><legend>Look</legend><div class="grid" id="modes">
<button type="button" data-mode="shaded">Shaded</button><button type="button" data-mode="isolines">Isolines</button>
<button type="button" data-mode="curvature">Curvature</button><button type="button" data-mode="zebra">Zebra</button></div></fieldset>
<fieldset id="isolines"><legend>Isolines of each patch</legend>
<label class="range">along u<input type="range" id="u" min="1" max="60"><output for="u"></output></label>
<label class="range">along v<input type="range" id="v" min="1" max="60"><output for="v"></output></label></fieldset>
<fieldset id="curvature"><legend>Curvature</legend><select id="quantity" aria-label="Kind of curvature">
<option value="gaussian">Gaussian</option><option value="mean">Mean</option>
<option value="k1">Larger principal, k1</option><option value="k2">Smaller principal, k2</option></select></fieldset>
<fieldset id="zebra"><legend>Reflected light strips</legend>
<label class="range">strips<input type="range" id="stripes" min="2" max="60"><output for="stripes"></output></label></fieldset>
<fieldset><legend>View</legend><div class="grid four" id="views">
<button type="button" data-view="iso">Iso</button><button type="button" data-view="front">Front</button>
<button type="button" data-view="top">Top</button><button type="button" data-view="side">Side</button></div>
<div class="row"><button type="button" id="fit">Fit to window</button><button type="button" id="save">Save picture</button></div></fieldset>
<fieldset><legend>Show</legend>
<label><input type="checkbox" id="borders"> Borders of patches</label>
<label><input type="checkbox" id="wireframe"> Triangles</label>
<label><input type="checkbox" id="perspective"> Perspective</label></fieldset>
<fieldset id="lines"><legend>Lines</legend><div id="roles"></div></fieldset>
<fieldset id="parts"><legend>Patches</legend><div id="patches"></div>
<div class="row"><button type="button" id="all">All</button><button type="button" id="none">None</button></div></fieldset>
<details><summary>Mouse and keys</summary><dl>
<dt>drag</dt><dd>turn</dd><dt>right drag, shift</dt><dd>move</dd><dt>wheel, pinch</dt><dd>zoom</dd><dt>click</dt><dd>values at a point</dd>
<dt>arrows</dt><dd>turn, with shift move</dd><dt>+ −</dt><dd>zoom</dd><dt>F</dt><dd>fit</dd><dt>0 1 2 3</dt><dd>iso, front, top, side</dd>
<dt>S I C Z</dt><dd>shaded, isolines, curvature, zebra</dd><dt>B W P</dt><dd>borders, triangles, perspective</dd></dl></details>
</aside>
<section id="legend" aria-label="Legend" hidden><h2></h2><div id="bar"></div><div id="ticks"></div><p id="extremes"></p></section>
<section id="point" aria-label="Values at a point" hidden><h2></h2><button type="button" aria-label="Close">×</button><dl></dl></section>
<p class="said" role="status" id="said"></p>
<div id="failed" class="failed" role="alert" hidden><p></p></div>
<noscript><div class="failed"><p>This page shows a surface that can be turned. It needs JavaScript, which is switched off here.</p></div></noscript>
)html";
}

}  // namespace obvid::exchange
