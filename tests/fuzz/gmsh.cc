#include "readers.h"

#include <vibrocontact/scene/gmsh_file.h>

using namespace vibrocontact;

void readers::gmsh(const std::string &bytes)
{
  const std::string file = file_of("mesh.msh", bytes);
  taken([&] { GmshFile::read(file).face_counts(); });
  taken([&] { GmshFile::read_section(file).face_counts(); });
}
