#include "readers.h"

#include <vibrocontact/matrices/dmig.h>
#include <vibrocontact/matrices/matrix_market.h>
#include <vibrocontact/scene/nastran_cards.h>

using namespace vibrocontact;

void readers::matrices(const std::string &bytes)
{
  const char kind = bytes.empty() ? 'm' : bytes[0];
  const std::string rest = bytes.substr(std::min<std::size_t>(1, bytes.size()));
  StoredMatrix matrix;
  taken(
      [&]
      {
        switch (kind)
        {
        case 'd':
        {
          // all of a file over the dofs that they have
          const auto all = read_dmig("matrices.pch", rest);
          std::vector<const DmigMatrix *> each;
          for (const auto &[name, one] : all)
            each.push_back(&one);
          const std::vector<MatrixDof> dofs = dofs_of(each);
          for (const DmigMatrix *const one : each)
            lower_triangle(stored(*one, dofs));
          break;
        }
        case 'g':
          read_grid_cards("nodes.bdf", rest);
          break;
        case 'c':
          lower_triangle(read_calculix_matrix("matrix.sti", rest, 12));
          break;
        case 'o':
          read_calculix_dofs("matrix.dof", rest);
          break;
        case 'i':
          read_deck("deck.inp", rest);
          break;
        case 't':
          read_dof_table("dofs.csv", rest);
          break;
        case 'n':
          read_node_table("nodes.csv", rest);
          break;
        case 's':
          read_group_table("groups.csv", rest);
          break;
        default:
          matrix = read_matrix_market("matrix.mtx", rest);
          // a body has as many dofs as its table has lines
          if (matrix.n_rows <= 1000)
            lower_triangle(matrix);
        }
      });
}
