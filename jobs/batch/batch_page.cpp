// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/batch/batch_page.h"

#include <fmt/format.h>

#include <ostream>
#include <sstream>

#include "io/base/base64.h"
#include "io/base/bytes_file.h"
#include "jobs/base/own_output.h"

namespace furrow::jobs {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_picture_bytes = std::size_t{64} << 20;

constexpr const char* page_style = R"(
:root{color-scheme:light dark;--line:#bbb;--bad:#b3261e;--open:#8a6d00}
@media(prefers-color-scheme:dark){:root{--line:#555;--bad:#ff8a80;--open:#e6c25c}}
body{font:15px/1.45 system-ui,sans-serif;margin:1.5rem}
table{border-collapse:collapse}
th,td{border-bottom:1px solid var(--line);padding:.3rem .7rem;text-align:left;vertical-align:top}
td.n{text-align:right;font-variant-numeric:tabular-nums}
th button{font:inherit;font-weight:600;background:none;border:0;padding:0;cursor:pointer;color:inherit}
th[aria-sort=ascending] button::after{content:" ▲"}th[aria-sort=descending] button::after{content:" ▼"}
.failed{color:var(--bad)}.open{color:var(--open)}
img{max-width:160px;max-height:200px;display:block}
input{font:inherit;padding:.2rem .5rem;margin:.5rem 0 1rem}
)";

constexpr const char* page_script = R"(
const body=document.querySelector('tbody'),heads=[...document.querySelectorAll('th')];
const key=(row,i)=>{const c=row.cells[i];return c.dataset.v!==undefined?+c.dataset.v:c.textContent.trim()};
heads.forEach((head,i)=>head.querySelector('button')?.addEventListener('click',()=>{
  const up=head.getAttribute('aria-sort')!=='ascending';
  heads.forEach(h=>h.removeAttribute('aria-sort'));head.setAttribute('aria-sort',up?'ascending':'descending');
  const rows=[...body.rows];
  rows.sort((a,b)=>{const x=key(a,i),y=key(b,i);
    const order=typeof x==='number'&&typeof y==='number'?x-y:String(x).localeCompare(String(y),undefined,{numeric:true});
    return up?order:-order});
  body.append(...rows)}));
document.querySelector('input').addEventListener('input',event=>{
  const words=event.target.value.toLowerCase().split(/\s+/).filter(Boolean);let shown=0;
  for(const row of body.rows){const text=row.textContent.toLowerCase();
    row.hidden=!words.every(word=>text.includes(word));shown+=!row.hidden}
  document.querySelector('output').textContent=shown+' of '+body.rows.length+' cases'});
)";

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += c;
  }
  return safe;
}

/// The value at "fit.strain.p99" of a report; null: it has none.
Json value_at(const Json& report, const std::string& path) {
  const Json* at = &report;
  std::istringstream names(path);
  for (std::string name; std::getline(names, name, '.');) {
    if (at->is_object() && at->contains(name))
      at = &(*at)[name];
    else if (at->is_array() && !name.empty() && name.size() < 7 &&
             name.find_first_not_of("0123456789") == std::string::npos && std::stoul(name) < at->size())
      at = &(*at)[std::stoul(name)];
    else
      return nullptr;
  }
  return *at;
}

std::string cell_of(const Json& value) {
  if (value.is_null()) return "<td></td>";
  if (value.is_number()) {
    const double number = value.get<double>();
    return fmt::format("<td class=n data-v={0}>{0:.4g}</td>", number);
  }
  return "<td>" + escaped(value.is_string() ? value.get<std::string>() : value.dump()) + "</td>";
}

std::string heading_of(const std::string& words) {
  return "<th scope=col><button type=button>" + escaped(words) + "</button></th>";
}

}  // namespace

BatchPage::BatchPage(const io::BatchPlan& plan, std::ostream& out) : plan_(plan), out_(out) {
  out_ << "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>" << batch_page_mark
       << "<meta name=viewport "
          "content=\"width=device-width\"><title>"
       << escaped(plan.title) << "</title><style>" << page_style << "</style></head>\n<body><h1>"
       << escaped(plan.title) << "</h1>\n<p>furrow " << escaped(plan.command) << ", " << plan.cases.size()
       << " cases.</p>\n<label>Cases with the words <input type=search></label> <output>" << plan.cases.size()
       << " of " << plan.cases.size() << " cases</output>\n<table><thead><tr>";
  for (const std::string& column : plan.columns) out_ << heading_of(column);
  out_ << heading_of("state");
  for (const std::string& path : plan.report) out_ << heading_of(path);
  out_ << heading_of("seconds");
  if (plan.picture && plan.draws()) out_ << "<th scope=col>picture</th>";
  out_ << heading_of("case") << "</tr></thead>\n<tbody>\n";
}

void BatchPage::add(const Json& row) {
  out_ << "<tr>";
  for (const std::string& column : plan_.columns) out_ << cell_of(value_at(row["values"], column));
  const std::string state = row["state"].get<std::string>(), error = row.value("error", std::string());
  const int exit_code = row.value("exit", 0);
  out_ << "<td class=" << (exit_code != 0 ? "failed" : state) << '>' << state;
  if (exit_code != 0) out_ << ", exit " << exit_code;
  if (!error.empty()) out_ << ": " << escaped(error);
  out_ << "</td>";
  const Json report = row.contains("report") ? row["report"] : Json(nullptr);
  for (const std::string& path : plan_.report) out_ << cell_of(value_at(report, path));
  out_ << cell_of(row.contains("seconds") ? row["seconds"] : Json(nullptr));
  if (plan_.picture && plan_.draws()) add_picture(row);
  out_ << "<td>" << row["case"].get<std::string>() << "</td></tr>\n";
}

void BatchPage::add_picture(const Json& row) {
  out_ << "<td>";
  if (row.contains("picture")) {
    const std::string name = row["picture"].get<std::string>();
    std::string source = escaped(name);
    if (picture_bytes_ < most_picture_bytes) {
      const std::vector<std::byte> bytes = io::read_bytes(plan_.output / name);
      picture_bytes_ += bytes.size();
      source = "data:image/png;base64," + io::to_base64(bytes);
    }
    out_ << "<img loading=lazy alt=\"case " << row["case"].get<std::string>() << "\" src=\"" << source
         << "\">";
  }
  out_ << "</td>";
}

void BatchPage::end() { out_ << "</tbody></table>\n<script>" << page_script << "</script></body></html>\n"; }

}  // namespace furrow::jobs
