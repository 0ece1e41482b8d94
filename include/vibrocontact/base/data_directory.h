#pragma once

#include <string>

namespace vibrocontact
{
  /// Folder of the files that the program needs while it runs: `meshes`, and `contrib` with the scripts of figures. The
  /// first of these that has them: the one told, share/vibrocontact of the place where the running program is
  /// installed, the source tree.
  std::string data_directory();

  /// Tells where it is: what find_package(vibrocontact) knows of an installation. Empty: nothing.
  void set_data_directory(const std::string &directory);
} // namespace vibrocontact
