#include "gl/glsl_namespace.hpp"

#include <array>
#include <cctype>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace opacity::gl {
namespace {

using Names = std::set<std::string, std::less<>>;

struct Token {
    std::string_view text;
    bool is_name = false;
    bool in_directive = false;  // a line that starts with #
};

bool starts_name(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}
bool goes_on(char c) {
    return starts_name(c) || std::isdigit(static_cast<unsigned char>(c));
}

// All of the text, in pieces: names, comments, spaces, numbers, and single characters else.
std::vector<Token> tokens_of(std::string_view text) {
    std::vector<Token> tokens;
    bool in_directive = false;
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view rest = text.substr(at);
        std::size_t length = 1;
        const auto run = [&](auto belongs) {
            while (length < rest.size() && belongs(rest[length])) ++length;
        };
        const char c = rest[0];
        if (rest.starts_with("//"))
            run([](char next) { return next != '\n'; });
        else if (rest.starts_with("/*"))
            length = std::min(rest.find("*/", 2), rest.size() - 2) + 2;
        else if (goes_on(c))
            run(goes_on);  // 1e5 is no name, but one piece as well
        else if (std::isspace(static_cast<unsigned char>(c)) && c != '\n')
            run([](char next) { return next == ' ' || next == '\t'; });
        if (c == '#') in_directive = true;
        if (c == '\n') in_directive = false;
        tokens.push_back({rest.substr(0, length), starts_name(c), in_directive});
        at += length;
    }
    return tokens;
}

bool is_blank(const Token& token) {
    return token.text.starts_with("//") || token.text.starts_with("/*") ||
           std::isspace(static_cast<unsigned char>(token.text[0]));
}

bool is_ours(const Token& token) {
    static const Names not_ours{
        "in",        "out",       "uniform", "buffer", "const",   "flat",   "precise", "readonly",
        "writeonly", "invariant", "defined", "if",     "ifdef",   "ifndef", "elif",    "else",
        "endif",     "define",    "undef",   "line",   "version", "layout"};
    return token.is_name && !not_ours.contains(token.text) && !token.text.starts_with("gl_");
}

// Reads the declarations of a file, one statement after the other.
class Declarations {
   public:
    explicit Declarations(const std::vector<Token>& tokens) {
        for (const Token& token : tokens) {
            if (is_blank(token)) continue;
            if (!token.in_directive)
                tokens_.push_back(token);
            else if (is_ours(token))
                names_.emplace(token.text);
        }
        while (at_ < tokens_.size()) statement();
    }
    const Names& names() const { return names_; }
    // Members keep their names: pieces of the text within the braces of a structure.
    bool is_member(const Token& token) const { return members_.contains(token.text.data()); }

   private:
    using Statement = std::vector<Token>;

    static bool holds(const Statement& statement, std::string_view word) {
        for (const Token& token : statement)
            if (token.text == word) return true;
        return false;
    }

    void statement() {
        Statement head;
        while (at_ < tokens_.size()) {
            const Token& token = tokens_[at_++];
            if (token.text == ";") return declare(head);
            if (token.text == "}") return;  // of a block, whose members are names of the file
            if (token.text != "{") {
                head.push_back(token);
                continue;
            }
            if (holds(head, "buffer")) {
                names_.emplace(head.back().text);
                return;
            }
            const bool is_structure = holds(head, "struct");
            skip_braces(is_structure);
            if (holds(head, "=")) continue;  // the values of an array
            return declare(head);
        }
    }

    void skip_braces(bool of_structure) {
        for (int depth = 1; at_ < tokens_.size() && depth > 0; ++at_) {
            const std::string_view text = tokens_[at_].text;
            depth += text == "{" ? 1 : text == "}" ? -1 : 0;
            const bool ends =
                at_ + 1 < tokens_.size() &&
                std::string_view{";,["}.find(tokens_[at_ + 1].text) != std::string_view::npos;
            if (of_structure && tokens_[at_].is_name && ends) members_.insert(text.data());
        }
    }

    // A function by the name before its parameters; else a name before each comma, bracket or
    // value.
    void declare(const Statement& statement) {
        const Token* last = nullptr;
        int depth = 0;
        bool in_layout = false, in_value = false;
        const auto take = [&] {
            if (last && !in_value) names_.emplace(last->text);
            last = nullptr;
        };
        for (const Token& token : statement) {
            if (token.text == "layout") in_layout = true;
            if (token.text == "(" && depth == 0 && !in_layout && !in_value) return take();
            if (token.text == "(" || token.text == "[") {
                if (depth == 0 && token.text == "[") take(), in_value = true;
                ++depth;
            } else if (token.text == ")" || token.text == "]") {
                if (--depth == 0) in_layout = false;
            } else if (depth == 0 && token.text == "=") {
                take();
                in_value = true;
            } else if (depth == 0 && token.text == ",") {
                take();
                in_value = false;
            } else if (depth == 0 && is_ours(token) && token.text != "struct") {
                last = &token;
            }
        }
        take();
    }

    std::vector<Token> tokens_;
    std::size_t at_ = 0;
    Names names_;
    std::set<const char*> members_;
};

}  // namespace

std::string in_namespace(std::string_view name, std::string_view space) {
    constexpr std::string_view kinds = "utibvo";
    const bool has_kind =
        name.size() > 2 && name[1] == '_' && kinds.find(name[0]) != std::string_view::npos;
    const std::size_t at = has_kind ? 2 : 0;
    return std::string{name.substr(0, at)} + std::string{space} + "_" +
           std::string{name.substr(at)};
}

std::string text_in_namespace(const std::string& text, std::string_view space) {
    const std::vector<Token> tokens = tokens_of(text);
    const Declarations declared{tokens};
    std::string result;
    char before = ' ';  // the last piece that is not blank
    for (const Token& token : tokens) {
        const bool renamed = token.is_name && before != '.' && !declared.is_member(token) &&
                             declared.names().contains(token.text);
        result += renamed ? in_namespace(token.text, space) : std::string{token.text};
        if (!is_blank(token)) before = token.text.back();
    }
    return result;
}

}  // namespace opacity::gl
