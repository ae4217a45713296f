// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "cli/words/command_words.h"

namespace furrow::cli {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between = " ") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// The help in one line without marks that a shell's own language has a meaning for.
std::string plain(std::string text) {
  for (const auto& [mark, other] : {std::pair('[', '('),
                                    {']', ')'},
                                    {':', ';'},
                                    {'\'', ' '},
                                    {'`', ' '},
                                    {'\\', ' '},
                                    {'\n', ' '},
                                    {'$', ' '}})
    std::replace(text.begin(), text.end(), mark, other);
  return text;
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

std::string bash(const std::vector<const CLI::App*>& commands) {
  std::ostringstream options, values;
  for (const CLI::App* command : commands) {
    std::vector<std::string> names;
    for (const OptionWords& option : words_of(*command).options) {
      if (!option.is_positional) names.insert(names.end(), option.names.begin(), option.names.end());
      if (option.choices.empty() || option.is_positional) continue;
      values << "    ";
      for (std::size_t i = 0; i < option.names.size(); ++i)
        values << (i ? "|" : "") << '"' << command->get_name() << ' ' << option.names[i] << '"';
      values << ") choices=\"" << joined(option.choices) << "\" ;;\n";
    }
    options << "    " << command->get_name() << ") options=\"" << joined(names) << "\" ;;\n";
  }
  return "# bash completion for furrow, written by: furrow completion bash\n"
         "_furrow() {\n"
         "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]}\n"
         "  local options=\"\" choices=\"\" commands=\"" +
         joined(names_of(commands)) +
         "\"\n"
         "  COMPREPLY=()\n"
         "  if [[ $cur == \"=\" ]]; then cur=\"\"\n"
         "  elif [[ $prev == \"=\" ]]; then prev=${COMP_WORDS[COMP_CWORD-2]}\n"
         "  fi\n"
         "  if ((COMP_CWORD == 1)); then\n"
         "    COMPREPLY=($(compgen -W \"$commands help --help --version\" -- \"$cur\"))\n"
         "    return\n"
         "  fi\n"
         "  case $command in\n"
         "    help|man) choices=$commands ;;\n"
         "    completion) choices=\"bash zsh fish\" ;;\n"
         "  esac\n"
         "  case \"$command $prev\" in\n" +
         values.str() +
         "  esac\n"
         "  if [[ -n $choices && $cur != -* ]]; then\n"
         "    compopt +o default 2>/dev/null\n"
         "    COMPREPLY=($(compgen -W \"$choices\" -- \"$cur\"))\n"
         "    return\n"
         "  fi\n"
         "  case $command in\n" +
         options.str() +
         "  esac\n"
         "  if [[ $cur == -* ]]; then COMPREPLY=($(compgen -W \"$options\" -- \"$cur\")); fi\n"
         "}\n"
         "complete -o default -F _furrow furrow\n";
}

/// One argument of zsh's _arguments.
std::string zsh_option(const OptionWords& option) {
  const std::string repeat = option.is_repeatable ? "*" : "";
  std::string action;
  if (!option.value.empty())
    action =
        ":" + option.value + ":" + (option.choices.empty() ? "_files" : "(" + joined(option.choices) + ")");
  if (option.is_positional)
    return "'" + (option.is_repeatable ? std::string("*") : std::string()) + ":" + option.names[0] + ":" +
           (option.choices.empty() ? "_files" : "(" + joined(option.choices) + ")") + "'";
  const std::string help = "'[" + plain(option.help) + "]" + action + "'";
  if (option.names.size() == 1) return "'" + repeat + option.names[0] + "'" + help;
  const std::string others = repeat.empty() ? "'(" + joined(option.names) + ")'" : "'" + repeat + "'";
  return others + "{" + joined(option.names, ",") + "}" + help;
}

std::string zsh(const std::vector<const CLI::App*>& commands) {
  std::ostringstream out;
  out << "#compdef furrow\n"
         "# zsh completion for furrow, written by: furrow completion zsh\n"
         "_furrow() {\n"
         "  local context state state_descr line\n"
         "  typeset -A opt_args\n"
         "  local -a commands\n"
         "  commands=(\n";
  for (const CLI::App* command : commands)
    out << "    '" << command->get_name() << ":" << plain(words_of(*command).summary) << "'\n";
  out << "    'help:Print help'\n"
         "  )\n"
         "  _arguments -C '--help[print help]' '--version[print the version]' '1:command:->command' "
         "'*::argument:->argument'\n"
         "  case $state in\n"
         "    command) _describe command commands ;;\n"
         "    argument)\n"
         "      case $line[1] in\n"
         "        help) _describe command commands ;;\n";
  for (const CLI::App* command : commands) {
    out << "        " << command->get_name() << ")\n          _arguments";
    for (OptionWords option : words_of(*command).options) {
      if (command->get_name() == "man" && option.is_positional) option.choices = names_of(commands);
      out << " \\\n            " << zsh_option(option);
    }
    out << "\n          ;;\n";
  }
  out << "      esac ;;\n  esac\n}\n_furrow \"$@\"\n";
  return out.str();
}

std::string fish(const std::vector<const CLI::App*>& commands) {
  std::ostringstream out;
  out << "# fish completion for furrow, written by: furrow completion fish\n"
         "complete -c furrow -n __fish_use_subcommand -f\n";
  for (const CLI::App* command : commands)
    out << "complete -c furrow -n __fish_use_subcommand -a " << command->get_name() << " -d '"
        << plain(words_of(*command).summary) << "'\n";
  out << "complete -c furrow -n __fish_use_subcommand -a help -d 'Print help'\n"
         "complete -c furrow -n '__fish_seen_subcommand_from help man' -f -a '"
      << joined(names_of(commands))
      << "'\n"
         "complete -c furrow -n '__fish_seen_subcommand_from completion' -f -a 'bash zsh fish'\n";
  for (const CLI::App* command : commands)
    for (const OptionWords& option : words_of(*command).options) {
      if (option.is_positional) continue;
      out << "complete -c furrow -n '__fish_seen_subcommand_from " << command->get_name() << "'";
      for (const std::string& name : option.names)
        out << (name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1));
      if (!option.choices.empty())
        out << " -x -a '" << joined(option.choices) << "'";
      else if (!option.value.empty())
        out << " -r";
      out << " -d '" << plain(option.help) << "'\n";
    }
  return out.str();
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  const std::vector<const CLI::App*> commands = shown_subcommands(app);
  if (shell == "bash") return bash(commands);
  if (shell == "zsh") return zsh(commands);
  if (shell == "fish") return fish(commands);
  throw std::invalid_argument("completion: '" + shell + "' is not bash, zsh or fish");
}

}  // namespace furrow::cli
