//! The looks of the page.

/// The style sheet.
pub(crate) const STYLE: &str = "
:root{--ink:#1d2330;--quiet:#667085;--line:#e3e6ec;--best:#c2410c;--other:#9aa3b2;--ground:#fff;--tint:#fff7f2}
*{box-sizing:border-box}
body{margin:0;background:#f6f7f9;color:var(--ink);font:15px/1.55 system-ui,-apple-system,'Segoe UI',Roboto,'DejaVu Sans',sans-serif}
main{max-width:1180px;margin:0 auto;padding:36px 28px 60px}
header{display:grid;grid-template-columns:1fr 260px;gap:40px;align-items:start;margin-bottom:8px}
h1{font-size:32px;line-height:1.15;margin:0 0 14px;letter-spacing:-.01em}
h2{font-size:19px;margin:0 0 12px}
.over{margin:0 0 4px;color:var(--best);font-weight:600;font-size:13px}
.advice{font-size:18px;line-height:1.5;margin:0 0 12px;max-width:46em}
.quiet{color:var(--quiet);font-size:13px;max-width:76em}
section{background:var(--ground);border:1px solid var(--line);border-radius:10px;padding:22px 24px;margin-top:20px}
figure{margin:0}
figcaption{color:var(--quiet);font-size:13px;margin-top:6px}
header img{width:100%;border-radius:10px;display:block}
.pair{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:22px}
svg{width:100%;height:auto;display:block}
svg text{font-family:inherit;font-size:11.5px}
svg .tick{fill:var(--quiet);font-size:11px}
svg .axis{fill:var(--quiet);font-size:12px}
svg .grid{stroke:var(--line);stroke-width:1;fill:none}
svg .front{stroke:var(--best);stroke-width:1.5;fill:none;opacity:.45}
svg .best{fill:var(--best)}
svg .other{fill:var(--other);opacity:.75}
svg .spread{stroke:var(--other);stroke-width:1.5;opacity:.5}
svg .spread.best{stroke:var(--best)}
svg .chosen{fill:var(--best);opacity:.2}
svg .saved{fill:none;stroke:var(--ink);stroke-width:1.4}
svg .name{font-weight:600;fill:var(--ink);paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}
svg .other-name{font-weight:400;fill:var(--quiet)}
.dot{display:inline-block;width:9px;height:9px;border-radius:50%;vertical-align:0}
.legend{display:flex;flex-wrap:wrap;gap:4px 26px;color:var(--quiet);font-size:13px;margin:14px 0 0}
.legend i{margin-right:7px}
svg .departing{fill:#fff;stroke:var(--other);stroke-width:1.4}
.dot.departing{border:1.5px solid var(--other)}
.dot.halo{background:var(--best);opacity:.25;width:14px;height:14px;vertical-align:-3px}
.choice{background:var(--best);color:#fff;border-radius:9px;padding:1px 8px;font-size:11px;font-weight:600;margin-left:4px}
.dot.best{background:var(--best)}.dot.other{background:var(--other)}.dot.ring{border:1.5px solid var(--ink)}
.scroll{overflow-x:auto}
table{border-collapse:collapse;width:100%;font-size:13.5px;font-variant-numeric:tabular-nums}
th{font-weight:600;color:var(--quiet);font-size:12.5px;text-align:right;padding:4px 10px;border-bottom:1px solid var(--line);vertical-align:bottom}
td{text-align:right;padding:5px 10px;border-bottom:1px solid var(--line);white-space:nowrap}
th:first-child,td:first-child{text-align:left;padding-left:8px}
td.text,th.text{text-align:left;white-space:normal}
tr:last-child td{border-bottom:0}
tr.front{background:var(--tint)}
tr.front td:first-child{color:var(--best);font-weight:600}
td small{color:var(--quiet)}
ul{margin:0;padding-left:20px}li{margin:3px 0}
.bar{display:inline-block;height:8px;border-radius:4px;background:var(--best);opacity:.75;min-width:2px;vertical-align:middle}
.bar.aside{background:var(--other)}
.reason{white-space:pre-line}
.scale{display:flex;gap:8px;align-items:center;max-width:320px;color:var(--quiet);font-size:12px;margin:4px 0 14px}
.scale i{flex:1;height:9px;border-radius:5px}
.maps{display:grid;grid-template-columns:repeat(auto-fill,minmax(170px,1fr));gap:18px}
.study svg{max-width:860px;margin:0 auto 12px}
.maps.small{grid-template-columns:repeat(auto-fill,minmax(120px,1fr));margin-bottom:14px}
summary{cursor:pointer;color:var(--best);font-weight:600;font-size:14px}
td.view:first-child{text-align:right}
table.dense th,table.dense td{padding:4px 6px;font-size:12px}
tr.group td{border-top:1px solid var(--other)}
td[rowspan]{vertical-align:top}
.maps img{width:100%;border-radius:6px;display:block}
code{font:13px ui-monospace,'DejaVu Sans Mono',monospace;background:#f0f2f5;border-radius:4px;padding:1px 5px}
@media(max-width:760px){header,.pair{grid-template-columns:1fr}}
";
