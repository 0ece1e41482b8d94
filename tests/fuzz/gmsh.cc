#include "readers.h"

#include <vibrocontact/scene/gmsh_file.h>

using namespace vibrocontact;

void readers::gmsh(const std::string &bytes)
{
  const std::string file = file_of("mesh.msh", bytes);
  taken([&] { GmshFile::read_section(file); });
}
