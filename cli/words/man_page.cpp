// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "cli/words/command_words.h"
#include "furrow/version.h"

namespace furrow::cli {
namespace {

/// The character that begins at text[i] in UTF-8, as roff names it; i goes to its last byte.
std::string named_character(const std::string& text, std::size_t& i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const int more = byte(i) >= 0xF0 ? 3 : byte(i) >= 0xE0 ? 2 : 1;
  unsigned code = byte(i) & (0x3Fu >> more);
  for (int k = 0; k < more && i + 1 < text.size(); ++k) code = code << 6 | (byte(++i) & 0x3Fu);
  char name[16];
  std::snprintf(name, sizeof name, "\\[u%04X]", code);
  return name;
}

/// As roff takes text: its own marks are masked, and a line begins with none of them.
std::string roff(const std::string& text) {
  std::string result;
  bool line_begins = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) >= 0x80) {
      result += named_character(text, i);
      line_begins = false;
      continue;
    }
    if (line_begins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if (c == '`')
      result += "\\(ga";
    else
      result += c;
    line_begins = c == '\n';
  }
  return result;
}

std::string upper(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string head(const std::string& name, const std::string& summary) {
  return ".TH \"" + roff(upper(name)) + "\" 1 \"\" \"Furrow " FURROW_VERSION "\" \"Furrow\"\n.SH NAME\n" +
         roff(name) + " \\- " + roff(summary) + "\n";
}

/// "garment [strokes] [options]"
std::string synopsis(const std::string& name, const CommandWords& words) {
  std::string text = ".SH SYNOPSIS\n.B furrow " + roff(name) + "\n";
  for (const OptionWords& option : words.options) {
    if (option.is_positional) {
      const std::string shown =
          "\\fI" + roff(option.names[0]) + "\\fR" + (option.is_repeatable ? " ..." : "");
      text += option.is_required ? shown + "\n" : "[" + shown + "]\n";
    } else if (option.is_required) {
      text += "\\fB" + roff(option.names.back()) + "\\fR \\fI" + roff(option.value) + "\\fR\n";
    }
  }
  return text + "[\\fIoptions\\fR]\n";
}

std::string option_entry(const OptionWords& option) {
  std::string text = ".TP\n";
  for (std::size_t i = 0; i < option.names.size(); ++i)
    text += (i ? ", " : "") + std::string(option.is_positional ? "\\fI" : "\\fB") + roff(option.names[i]) +
            "\\fR";
  if (!option.value.empty() && !option.is_positional) text += " \\fI" + roff(option.value) + "\\fR";
  text += "\n" + roff(option.help.empty() ? "What it says." : option.help) + "\n";
  if (!option.choices.empty()) {
    std::string list;
    for (const std::string& word : option.choices) list += (list.empty() ? "" : ", ") + word;
    text += ".br\nOne of: " + roff(list) + ".\n";
  }
  return text;
}

std::string examples(const CommandWords& words) {
  if (words.examples.empty()) return "";
  std::string text = ".SH EXAMPLES\n.nf\n";
  for (const std::string& line : words.examples) text += roff(line) + "\n";
  return text + ".fi\n";
}

const char* const exit_status =
    ".SH EXIT STATUS\n"
    ".TP\n0\nIt came to what was asked for.\n"
    ".TP\n1\nIt failed: a file cannot be written, memory ran out.\n"
    ".TP\n2\nIt was called wrongly.\n"
    ".TP\n3\nAn input cannot be read or used.\n"
    ".TP\n4\nIt was done, but did not come to rest, or did not pass a check; the report says what.\n"
    ".TP\n130\nIt was interrupted.\n";

}  // namespace

std::string man_page(const CLI::App& app) {
  const CommandWords words = words_of(app);
  std::string text = head("furrow", words.summary) + ".SH SYNOPSIS\n.B furrow\n\\fIcommand\\fR ...\n";
  text += ".SH DESCRIPTION\n" + roff(words.details) + ".SH COMMANDS\n";
  for (const CLI::App* command : shown_subcommands(app))
    text +=
        ".TP\n.BR furrow\\-" + roff(command->get_name()) + " (1)\n" + roff(words_of(*command).summary) + "\n";
  text += ".SH OPTIONS\n";
  for (const OptionWords& option : words.options) text += option_entry(option);
  text += examples(words) + exit_status;
  return text +
         ".SH ENVIRONMENT\n.TP\nNO_COLOR\nIf it is set and not empty, progress is told in plain lines, on a "
         "terminal, too. The program writes no colours.\n";
}

std::string man_page(const CLI::App& app, const CLI::App& subcommand) {
  const CommandWords words = words_of(subcommand);
  std::string text = head("furrow-" + words.name, words.summary) + synopsis(words.name, words);
  text += ".SH DESCRIPTION\n" + roff(words.summary) + ".\n";
  if (!words.details.empty()) text += ".PP\n" + roff(words.details);
  text += ".SH OPTIONS\n";
  for (const OptionWords& option : words.options) text += option_entry(option);
  text += examples(words) + exit_status + ".SH SEE ALSO\n.BR furrow (1)";
  for (const CLI::App* other : shown_subcommands(app))
    if (other != &subcommand) text += ",\n.BR furrow\\-" + roff(other->get_name()) + " (1)";
  return text + "\n";
}

}  // namespace furrow::cli
