// Walks over Wavefront text, statement by statement and word by word, without a copy: comments,
// CRLF and lines continued by a backslash are handled here and nowhere else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "opacity/core/error.hpp"

namespace opacity {

class TextCursor {
   public:
    // `text` must outlive the cursor; `path` is for messages.
    TextCursor(const std::filesystem::path& path, std::string_view text);

    // To the next line that is not empty and not a comment; false at the end of the text.
    bool next_statement();
    // The statement's next word; empty at its end.
    std::string_view word();
    // What is left of the line as it stands, for names with spaces.
    std::string_view rest();

    // The statement's next word as a number; FileFormatError where it is none, infinite or NaN.
    double number(const char* what);
    FileFormatError error(const std::string& problem, const std::string& fix) const;

   private:
    void skip_blanks();
    // The length of a backslash with its end of line, or 0.
    std::size_t continuation() const;

    std::string name_;
    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
    bool in_statement_ = false;
};

}  // namespace opacity
