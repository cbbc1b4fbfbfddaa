#include "cli/manual_pages.h"

#include <fmt/format.h>

namespace transillum::cli {

namespace {

/// Text as roff shows it as it is.
std::string plain(const std::string& text) {
    std::string result;
    bool begins_line = true;
    for (const char c : text) {
        if (begins_line && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
        begins_line = c == '\n';
    }
    return result;
}

std::string heading(const CLI::App& program, const std::string& title, const std::string& name,
                    const std::string& what) {
    return fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n", title,
                       plain(program.version()), plain(name), plain(what));
}

/// "-o, --output=TEXT"
std::string invocation(const CLI::Option& option) {
    std::string names = option.get_name(option.get_positional(), true);
    for (std::size_t at = 0; (at = names.find(',', at)) != std::string::npos; at += 2)
        names.insert(at + 1, " ");
    const bool takes_value = option.nonpositional() && option.get_items_expected_max() > 0 &&
                             option.get_type_size_max() > 0;
    const std::string type = option.get_type_name();
    return "\\fB" + plain(names) + "\\fR" +
           (takes_value && !type.empty() ? " \\fI" + plain(type) + "\\fR" : "");
}

std::string options_section(const CLI::App& command) {
    std::string text;
    for (const std::string& group : command.get_groups()) {
        if (group.empty()) continue;  // hidden
        const auto options =
            command.get_options([&](const CLI::Option* o) { return o->get_group() == group; });
        if (options.empty()) continue;
        text += ".SS " + plain(group) + "\n";
        for (const CLI::Option* option : options) {
            text += ".TP\n" + invocation(*option) + "\n" + plain(option->get_description());
            if (option->get_required()) text += " (required)";
            if (const std::string value = option->get_default_str(); !value.empty())
                text += " [" + plain(value) + "]";
            text += "\n";
        }
    }
    return text.empty() ? text : ".SH OPTIONS\n" + text;
}

/// What stands below the options of --help, line by line.
std::string footer_section(const CLI::App& app) {
    if (app.get_footer().empty()) return {};
    return ".SH NOTES\n.nf\n" + plain(app.get_footer()) + "\n.fi\n";
}

std::string synopsis(const CLI::App& command) {
    std::string text;
    for (const CLI::Option* o : command.get_options())
        if (o->get_positional()) text += " \\fI" + plain(o->get_name(true)) + "\\fR";
    return text + " [\\fIOPTION\\fR]...";
}

}  // namespace

std::vector<ManualPage> manual_pages(const CLI::App& program) {
    const std::string name = program.get_name();
    std::string whole = heading(program, "TRANSILLUM", name, program.get_description());
    whole += ".SH SYNOPSIS\n\\fB" + name + "\\fR \\fISUBCOMMAND\\fR [\\fIOPTION\\fR]...\n";
    whole += ".SH SUBCOMMANDS\n";
    std::vector<ManualPage> pages(1);
    std::string others;
    for (const CLI::App* command : program.get_subcommands({})) {
        const std::string full = name + "-" + command->get_name();
        whole += fmt::format(".TP\n\\fB{}\\fR\n{}\n", plain(command->get_name()),
                             plain(command->get_description()));
        others += fmt::format("{}\\fB{}\\fR(1)", others.empty() ? "" : ",\n", plain(full));
        std::string page = heading(program, plain(full), full, command->get_description()) +
                           ".SH SYNOPSIS\n\\fB" + name + " " + plain(command->get_name()) + "\\fR" +
                           synopsis(*command) + "\n" + options_section(*command) +
                           footer_section(*command) + ".SH SEE ALSO\n\\fB" + name + "\\fR(1)\n";
        pages.push_back({full + ".1", std::move(page)});
    }
    whole += options_section(program) + footer_section(program) + ".SH SEE ALSO\n" + others + "\n";
    pages.front() = {name + ".1", std::move(whole)};
    return pages;
}

}  // namespace transillum::cli
