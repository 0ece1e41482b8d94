#pragma once

#include <vibrocontact/scene/section.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Refuses what cannot be the outline of a section: a part whose name nothing knows (it would become bare surface without
  /// a word), or a size that no wheel or rail has (metres where millimetres are read).
  /// @param parts names that mean something to the body; `surface` and `joint` (between regions) mean none and are known to all
  /// @param scale factor on all lengths with which it was read: the size is that of the file
  /// @throws InputError naming the file, the line and the names that are known, or the size
  void check_outline(const SectionOutline &outline, const std::vector<std::string> &parts,
                     const std::string &file, double scale);
} // namespace vibrocontact
