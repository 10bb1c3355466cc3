#pragma once
#include <span>
#include <string_view>

namespace roomwise::viewer {

/// A file of the page, which lies in the program itself.
struct PageFile {
  std::string_view path;  ///< of the URL, "/page.js"
  std::string_view type;  ///< of its content
  std::string_view content;
};

std::span<const PageFile> page_files();

}  // namespace roomwise::viewer
