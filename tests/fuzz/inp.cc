#include "readers.h"

#include <vibrocontact/scene/file_cells.h>
#include <vibrocontact/scene/split_cells.h>

using namespace vibrocontact;

void readers::inp(const std::string &bytes)
{
  const std::string file = file_of("deck.inp", bytes);
  taken([&] { solid_cells(read_inp(file), file).face_counts(); });
  taken([&] { solid_cells(split_into_tetrahedra(read_inp(file), file), file).face_counts(); });
}
