#pragma once

#include <string>

namespace vibrocontact
{
  /// Draws the figures of a finished run by contrib/plot_results.py, on rank 0, into folder/figures. A
  /// missing Python or matplotlib is said in the log and is no error.
  /// @param option of the script, in front of the folder
  void draw_figures(const std::string &folder, const std::string &option = "");
} // namespace vibrocontact
