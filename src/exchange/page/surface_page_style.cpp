// SPDX-License-Identifier: Apache-2.0
#include "surface_page_parts.h"

namespace obvid::exchange {

std::string_view surface_page_style() {
  return R"css(
:root{color-scheme:light dark;--ink:#1c2733;--soft:#5b6773;--line:#d5dce3;--panel:#ffffffd9;--press:#1b5fae;
--on-press:#fff;--hover:#1b5fae14;--back:radial-gradient(120% 95% at 45% 38%,#fbfcfd 0%,#eef2f6 55%,#dde4eb 100%)}
@media (prefers-color-scheme:dark){:root{--ink:#e6eaee;--soft:#9aa6b2;--line:#36414c;--panel:#1a2129e0;--press:#4c94e0;
--on-press:#0c1116;--hover:#6cb2ff1f;--back:radial-gradient(120% 95% at 45% 38%,#2a333d 0%,#1b2229 55%,#10151a 100%)}}
*{box-sizing:border-box}
html,body{height:100%;margin:0;overflow:hidden}
body{font:14px/1.4 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif;color:var(--ink);background:var(--back)}
#view{position:fixed;inset:0;width:100%;height:100%;display:block;touch-action:none;cursor:grab;outline:none}
#view:active{cursor:grabbing}
#view:focus-visible{box-shadow:inset 0 0 0 2px var(--press)}
#over{position:fixed;inset:0;width:100%;height:100%;pointer-events:none}
#over text{font-size:12px;font-weight:600}
header{position:fixed;left:24px;top:20px;max-width:min(46ch,calc(100% - 340px));pointer-events:none}
h1{font-size:20px;font-weight:600;line-height:1.25;margin:0 0 2px;overflow-wrap:anywhere;letter-spacing:-.01em}
header p{margin:0;color:var(--soft);font-size:13px}
#panel,#legend,#point{background:var(--panel);border:1px solid var(--line);border-radius:12px;backdrop-filter:blur(14px);
box-shadow:0 6px 24px #0f1c2b14}
#panel{position:fixed;right:20px;top:20px;width:268px;max-height:calc(100% - 40px);overflow:auto;padding:14px 16px}
fieldset{border:0;margin:0 0 14px;padding:0;min-width:0}
legend{padding:0;margin:0 0 6px;font-size:12px;color:var(--soft)}
.grid{display:grid;gap:6px;grid-template-columns:1fr 1fr}.grid.four{grid-template-columns:repeat(4,1fr)}
button,select{font:inherit;font-size:13px;color:inherit;background:transparent;border:1px solid var(--line);border-radius:8px;
padding:6px 4px;cursor:pointer;min-height:32px}
select{width:100%;padding:5px 8px}select option{color:#1c2733;background:#fff}
button:hover{background:var(--hover)}
button[aria-pressed=true]{background:var(--press);border-color:var(--press);color:var(--on-press)}
button:focus-visible,select:focus-visible,input:focus-visible,summary:focus-visible{outline:2px solid var(--press);outline-offset:2px}
label{display:flex;align-items:center;gap:8px;min-height:28px;font-size:13px}
label.range{display:grid;grid-template-columns:56px 1fr 28px}
label output{text-align:right;font-variant-numeric:tabular-nums}
input{accent-color:var(--press);margin:0}input[type=range]{width:100%;min-width:0}
#patches,#roles{max-height:26vh;overflow:auto}
#patches span,#roles span{overflow:hidden;text-overflow:ellipsis;white-space:nowrap}
.row{display:flex;gap:6px;margin-top:6px}.row button{flex:1}
details{font-size:12.5px;color:var(--soft)}summary{cursor:pointer;min-height:24px}
dl{display:grid;grid-template-columns:auto 1fr;gap:2px 10px;margin:6px 0 0}dt{white-space:nowrap;color:var(--ink)}dd{margin:0}
#legend{position:fixed;left:50%;bottom:20px;transform:translateX(calc(-50% - 144px));width:min(440px,calc(100% - 300px));padding:9px 30px 7px}
#legend h2{font-size:13px;font-weight:600;margin:0 0 6px}
#legend h2 small{font-weight:400;color:var(--soft)}
#bar{height:12px;border-radius:3px}
#ticks{position:relative;height:20px;font-size:12px;font-variant-numeric:tabular-nums}
#ticks span{position:absolute;transform:translateX(-50%);white-space:nowrap;top:2px}
#extremes{margin:2px 0 0;font-size:12px;color:var(--soft)}
#point{position:fixed;left:24px;top:112px;padding:10px 14px;font-size:12.5px;max-width:300px}
#point dl{font-variant-numeric:tabular-nums;margin:2px 0 0}#point h2{font-size:13px;margin:0;padding-right:24px;overflow-wrap:anywhere}
#point dt{color:var(--soft)}
#point button{position:absolute;right:6px;top:4px;border:0;min-height:24px;padding:0 6px}
.failed{position:fixed;inset:0;display:grid;place-items:center;padding:32px;text-align:center}
.failed p{max-width:52ch;font-size:16px}
[hidden]{display:none!important}
.said{position:absolute;width:1px;height:1px;overflow:hidden;clip-path:inset(50%)}
@media (max-width:720px){header{left:16px;top:12px;max-width:calc(100% - 32px)}h1{font-size:17px}
#panel{left:10px;right:10px;top:auto;bottom:10px;width:auto;max-height:38%;padding:10px 12px}
#legend{left:10px;right:10px;width:auto;transform:none;top:64px;bottom:auto}#point{left:10px;top:150px}}
)css";
}

}  // namespace obvid::exchange
