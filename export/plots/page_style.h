#pragma once

namespace pleinair::exports {

/// Style of all pages by pleinair; follows the reader's light or dark mode.
inline constexpr const char* kPageStyle = R"(
:root{color-scheme:light dark;--paper:#fbfaf7;--ink:#22262b;--soft:#6a7079;--rule:#dcdad3;
--card:#fff;--warn:#9a5b00;--c0:#c2452d;--c1:#2f7d4f;--c2:#2c62b5}
@media(prefers-color-scheme:dark){:root{--paper:#15181c;--ink:#e4e6e8;--soft:#98a0a8;
--rule:#2d3238;--card:#1c2025;--warn:#e0a447;--c0:#ef7f66;--c1:#6cc090;--c2:#7aa8ee}}
*{box-sizing:border-box}body{margin:0 auto;padding:2rem 1.2rem 4rem;max-width:62rem;
background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,sans-serif}
h1{font-size:1.6rem;margin:0}h2{font-size:1.1rem;margin:2.2rem 0 .6rem}
p.lead{color:var(--soft);margin:.3rem 0 1.2rem}code{overflow-wrap:anywhere}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(11rem,1fr));gap:.8rem}
.card{background:var(--card);border:1px solid var(--rule);border-radius:8px;padding:.7rem .9rem}
.card b{display:block;font-size:1.25rem;font-variant-numeric:tabular-nums}
.card span{color:var(--soft);font-size:.85rem}
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(20rem,1fr));gap:1rem}
figure{margin:0}figcaption{color:var(--soft);font-size:.85rem}
.pair{position:relative;display:block;overflow:hidden;border-radius:8px}
.pair img{display:block;width:100%}
.pair .after{position:absolute;inset:0;clip-path:inset(0 0 0 var(--cut,50%))}
.pair::after{content:"";position:absolute;top:0;bottom:0;left:var(--cut,50%);width:2px;
background:#fff;box-shadow:0 0 4px #0008}
input[type=range]{width:100%;accent-color:var(--c0)}
.plot{width:100%;height:auto;background:var(--card);border:1px solid var(--rule);
border-radius:8px;margin-bottom:.8rem}
.plot path{fill:none;stroke-width:1.6}.plot text{font-size:12px;fill:var(--soft)}
.plot .title{font-weight:600;fill:var(--ink)}.grid{stroke:var(--rule)}
.line0{stroke:var(--c0)}.line1{stroke:var(--c1)}.line2{stroke:var(--c2)}
.plot .legend0{fill:var(--c0)}.plot .legend1{fill:var(--c1)}.plot .legend2{fill:var(--c2)}
table{border-collapse:collapse;width:100%}th,td{text-align:right;padding:.35rem .6rem;
border-bottom:1px solid var(--rule);font-variant-numeric:tabular-nums}
th:first-child,td:first-child{text-align:left}th{color:var(--soft);font-weight:500}
ul.warnings{padding-left:1.2rem;color:var(--warn)}
)";

}  // namespace pleinair::exports
