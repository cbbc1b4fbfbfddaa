#include "cli/completion.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace transillum::cli {

namespace {

bool is_shown(const CLI::Option* option) {
    return option->nonpositional() && !option->get_group().empty();
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
    return command.get_options(is_shown);
}

/// "-o --output"
std::string names_of(const CLI::Option& option) {
    std::string names;
    for (const std::string& name : option.get_snames()) names += " -" + name;
    for (const std::string& name : option.get_lnames()) names += " --" + name;
    return names.substr(std::min<std::size_t>(1, names.size()));
}

/// Those that an option accepts, where its type lists them: "auto off".
std::string words_of(const CLI::Option& option) {
    std::string words = option.get_type_name();
    if (words.find('|') == std::string::npos) return {};
    std::ranges::replace(words, '|', ' ');
    return words;
}

std::string all_names(const CLI::App& command) {
    std::string names;
    for (const CLI::Option* o : options_of(command))
        names += (names.empty() ? "" : " ") + names_of(*o);
    return names;
}

/// \param start of a pattern, up to the option
std::string bash_words(const CLI::App& command, const std::string& start) {
    std::string cases;
    for (const CLI::Option* option : options_of(command)) {
        const std::string words = words_of(*option);
        if (words.empty()) continue;
        for (const std::string& long_name : option->get_lnames())
            cases += fmt::format("        {} --{}') words='{}' ;;\n", start, long_name, words);
    }
    return cases;
}

std::string fish_quoted(std::string text) {
    for (std::size_t at = 0; (at = text.find_first_of("'\\", at)) != std::string::npos; at += 2)
        text.insert(at, "\\");
    return "'" + text + "'";
}

std::string fish_options(const CLI::App& command, const std::string& condition) {
    std::string lines;
    for (const CLI::Option* option : options_of(command)) {
        std::string line = "complete -c transillum" + condition;
        for (const std::string& name : option->get_snames()) line += " -s " + name;
        for (const std::string& name : option->get_lnames()) line += " -l " + name;
        if (const std::string words = words_of(*option); !words.empty())
            line += " -x -a " + fish_quoted(words);
        else if (option->get_type_size_max() > 0)
            line += " -r";
        lines += line + " -d " + fish_quoted(option->get_description()) + "\n";
    }
    return lines;
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
    std::string subcommands, words = bash_words(program, "*'"), options;
    for (const CLI::App* command : program.get_subcommands({})) {
        const std::string& name = command->get_name();
        subcommands += (subcommands.empty() ? "" : " ") + name;
        words += bash_words(*command, "'" + name);
        options += fmt::format("        '{}') options+=' {}' ;;\n", name, all_names(*command));
    }
    return "# bash completion of transillum\n"
           "_transillum() {\n"
           "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
           "    local subcommands='" +
           subcommands + "' command='' word words='' options='" + all_names(program) +
           "'\n"
           "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
           "        if [[ \" $subcommands \" == *\" $word \"* ]]; then command=$word; break; fi\n"
           "    done\n"
           "    case \"$command\" in\n" +
           options +
           "    esac\n"
           "    case \"$command $previous\" in\n" +
           words +
           "    esac\n"
           "    if [[ -n $words ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
           "    elif [[ $current == -* ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$options\" -- \"$current\"))\n"
           "    elif [[ -z $command ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$subcommands\" -- \"$current\"))\n"
           "    else\n"
           "        compopt -o filenames 2>/dev/null\n"
           "        mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
           "    fi\n"
           "}\n"
           "complete -F _transillum transillum\n";
}

std::string fish_completion(const CLI::App& program) {
    std::string text = "# fish completion of transillum\n" + fish_options(program, "");
    for (const CLI::App* command : program.get_subcommands({})) {
        const std::string& name = command->get_name();
        text += fmt::format("complete -c transillum -n __fish_use_subcommand -f -a {} -d {}\n",
                            name, fish_quoted(command->get_description()));
        text += fish_options(*command, " -n '__fish_seen_subcommand_from " + name + "'");
    }
    return text;
}

}  // namespace transillum::cli
