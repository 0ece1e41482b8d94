#include <vibrocontact/scene/mesh_compactness.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vibrocontact
{
  namespace
  {
    using Mesh = dealii::parallel::TriangulationBase<3>;

    /// Active cells in each coarse cell.
    std::vector<double> active_cells(const Mesh &triangulation)
    {
      std::vector<double> number(triangulation.n_cells(0), 0.);
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          Mesh::cell_iterator ancestor = cell;
          while (ancestor->level() > 0)
            ancestor = ancestor->parent();
          number[ancestor->index()] += 1;
        }
      MPI_Allreduce(MPI_IN_PLACE, number.data(), number.size(), MPI_DOUBLE, MPI_SUM,
                    triangulation.get_communicator());
      return number;
    }

    /// Coarse cells by their distance from one of them; those that it does not reach are in none.
    std::vector<std::vector<int>> levels(const Mesh &triangulation, const int first)
    {
      std::vector<char> seen(triangulation.n_cells(0), 0);
      std::vector<std::vector<int>> result{{first}};
      seen[first] = 1;
      while (!result.back().empty())
      {
        std::vector<int> next;
        for (const int index : result.back())
        {
          const Mesh::cell_iterator cell(&triangulation, 0, index);
          for (const unsigned int face : cell->face_indices())
            if (!cell->at_boundary(face) && !seen[cell->neighbor(face)->index()])
            {
              seen[cell->neighbor(face)->index()] = 1;
              next.push_back(cell->neighbor(face)->index());
            }
        }
        result.push_back(std::move(next));
      }
      result.pop_back();
      return result;
    }
  } // namespace

  double mesh_compactness(const Mesh &triangulation)
  {
    // sum over the levels from a corner of a cube of N cells, over N^(4/3)
    constexpr double of_cube = 0.728;
    const std::vector<double> number = active_cells(triangulation);
    std::vector<char> counted(number.size(), 0);
    double sum = 0, total = 0;
    for (unsigned int c = 0; c < number.size(); ++c)
    {
      total += number[c];
      if (counted[c])
        continue;
      // the cell furthest from a furthest one lies at an end
      int end = c;
      for (unsigned int sweep = 0; sweep < 2; ++sweep)
        end = levels(triangulation, end).back().front();
      for (const std::vector<int> &level : levels(triangulation, end))
      {
        double cells = 0, cut = 0;
        for (const int index : level)
        {
          counted[index] = 1;
          cells += number[index];
          cut += std::pow(number[index], 2. / 3);
        }
        sum += cells * std::sqrt(cut);
      }
    }
    return sum / (of_cube * std::pow(total, 4. / 3));
  }
} // namespace vibrocontact
