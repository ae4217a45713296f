// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/keywords.h"

namespace furrow::python {
namespace {

template <class T>
std::string type_text() {
  if constexpr (std::is_same_v<T, double>) return "float";
  if constexpr (std::is_same_v<T, int>) return "int";
  if constexpr (std::is_same_v<T, bool>) return "bool";
  if constexpr (std::is_same_v<T, std::string>) return "str";
  if constexpr (std::is_same_v<T, std::filesystem::path>) return "Path";
  if constexpr (std::is_same_v<T, jobs::MeshInput>) return "Mesh | Path";
  if constexpr (std::is_same_v<T, jobs::StrokeInput>) return "Strokes";
  if constexpr (requires { typename T::value_type; } && !std::is_same_v<T, std::string> &&
                !std::is_same_v<T, std::filesystem::path>) {
    using Item = typename T::value_type;
    const std::string item = type_text<Item>();
    return std::is_same_v<T, std::vector<Item>> ? item + " | Sequence[" + item + "]" : item;
  }
}

std::string list_of(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "\"" : ", \"") + word + "\"";
  return list;
}

/// A share in (0, 1): 0.01, or "1%".
double share_of(const Value& value) {
  double share = 0;
  if (py::isinstance<py::str>(value.given)) {
    const std::string text = py::cast<std::string>(value.given);
    char* end = nullptr;
    share = std::strtod(text.c_str(), &end) / 100;
    if (end == text.c_str() || std::string(end) != "%") value.fail("a share such as 0.01 or \"1%\"");
  } else {
    take(value, share);
  }
  if (!(share > 0 && share < 1)) value.fail("a share above 0 and below 1");
  return share;
}

struct Setter {
  std::string type;
  std::function<void(const Value&)> set;
};

/// How a row is set, by what its value is.
struct SetterOf {
  template <class Field>
  Setter operator()(Field* field) const {
    return {type_text<Field>(), [field](const Value& value) { take(value, *field); }};
  }
  Setter operator()(const jobs::Flag& flag) const {
    return {"bool", [set = flag.set](const Value& value) {
              bool is_on = false;
              take(value, is_on);
              set(is_on);
            }};
  }
  Setter operator()(const jobs::Choice& choice) const {
    const std::string list = list_of(choice.words);
    return {"Literal[" + list + "]", [choice, list](const Value& value) {
              std::string given;
              if (is_text(value.given)) take(value, given);
              const auto at = std::find(choice.words.begin(), choice.words.end(), given);
              if (at == choice.words.end()) value.fail("one of " + list);
              choice.set(std::size_t(at - choice.words.begin()));
            }};
  }
  Setter operator()(const jobs::Whole& x) const {
    return {"int", [set = x.set](const Value& value) {
              int number = 0;
              take(value, number);
              set(number);
            }};
  }
  Setter operator()(std::string* text) const {
    return {"Path", [text](const Value& value) { take(value, *text); }};
  }
  Setter operator()(const jobs::OrAuto& x) const {
    return {"int | Literal[\"auto\"]", [number = x.number](const Value& value) {
              number->reset();
              if (py::isinstance<py::str>(value.given) && py::cast<std::string>(value.given) == "auto")
                return;
              take(value, *number);
            }};
  }
  Setter operator()(const jobs::Share& x) const {
    return {"float | str", [set = x.set](const Value& value) { set(share_of(value)); }};
  }
  Setter operator()(const jobs::NamedNumbers& x) const {
    return {"Mapping[str, float]", [x](const Value& value) {
              if (!py::isinstance<py::dict>(value.given))
                value.fail("a dict from " + x.name + " to " + x.number);
              for (const auto& [name, given] : py::reinterpret_borrow<py::dict>(value.given)) {
                double number = 0;
                take(Value{value.keyword, given}, number);
                try {
                  x.add(py::cast<std::string>(py::str(name)), number);
                } catch (const std::invalid_argument& e) {
                  throw std::invalid_argument(value.keyword + ": " + e.what());
                }
              }
            }};
  }
  Setter operator()(const jobs::Listed& x) const { return (*this)(x.words); }
};

}  // namespace

Keywords keywords_of(const std::vector<jobs::CardRow>& card) {
  Keywords keywords;
  for (const jobs::CardRow& row : card) {
    Setter setter = std::visit(SetterOf{}, row.value);
    const std::string name = row.name == "lambda" ? "lambda_" : row.name;  // a word of Python
    keywords.push_back({{name, setter.type, in_python(described(row, true))}, std::move(setter.set)});
  }
  return keywords;
}

}  // namespace furrow::python
