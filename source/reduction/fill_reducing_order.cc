#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/reduction/fill_reducing_order.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <metis.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <unordered_map>

namespace vibrocontact
{
  namespace
  {
    // Sorted columns of a local row.
    void columns_of(Mat matrix, const PetscInt row, std::vector<int> &columns)
    {
      PetscInt n = 0;
      const PetscInt *c = nullptr;
      MatGetRow(matrix, row, &n, &c, nullptr);
      columns.assign(c, c + n);
      MatRestoreRow(matrix, row, &n, &c, nullptr);
      std::sort(columns.begin(), columns.end());
    }

    std::uint64_t hash_of(const std::vector<int> &columns)
    {
      std::uint64_t h = 1469598103934665603ull;
      for (const int c : columns)
        h = (h ^ static_cast<std::uint64_t>(c)) * 1099511628211ull;
      return h;
    }

    std::vector<int> gather_all(const std::vector<int> &local, MPI_Comm communicator)
    {
      const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
      const auto sizes = dealii::Utilities::MPI::all_gather(communicator, static_cast<int>(local.size()));
      std::vector<int> offsets(n_ranks + 1, 0);
      std::partial_sum(sizes.begin(), sizes.end(), offsets.begin() + 1);
      std::vector<int> all(offsets.back());
      MPI_Allgatherv(local.data(), local.size(), MPI_INT, all.data(), sizes.data(), offsets.data(), MPI_INT,
                     communicator);
      return all;
    }

    /// Place of every dof in the order (from 1), from the compressed graph: neighbours of each
    /// representative, in the order of their numbers. By rank 0.
    std::vector<int> positions(const std::vector<int> &representative, const std::vector<char> &is_last,
                               const std::vector<int> &sizes, const std::vector<int> &neighbours)
    {
      const int n = representative.size();
      std::vector<idx_t> vertex(n, -1), weight, start(1, 0), adjacency;
      std::vector<int> vertices;
      for (int dof = 0; dof < n; ++dof)
        if (!is_last[dof] && representative[dof] == dof)
        {
          vertex[dof] = vertices.size();
          vertices.push_back(dof);
          weight.push_back(0);
        }
      for (int dof = 0; dof < n; ++dof)
        if (!is_last[dof])
          ++weight[vertex[representative[dof]]];
      AssertThrow(vertices.size() == sizes.size(), dealii::ExcInternalError());
      for (const int size : sizes)
        start.push_back(start.back() + size);
      adjacency.reserve(neighbours.size());
      for (const int dof : neighbours)
        adjacency.push_back(vertex[dof]);

      idx_t n_vertices = vertices.size();
      std::vector<idx_t> permutation(n_vertices), inverse(n_vertices), options(METIS_NOPTIONS);
      METIS_SetDefaultOptions(options.data());
      options[METIS_OPTION_NUMBERING] = 0;
      options[METIS_OPTION_COMPRESS] = 0;
      options[METIS_OPTION_SEED] = 1;
      const int error = n_vertices == 0
                            ? int(METIS_OK)
                            : METIS_NodeND(&n_vertices, start.data(), adjacency.data(), weight.data(),
                                           options.data(), permutation.data(), inverse.data());
      if (error != METIS_OK)
        throw ConvergenceError("METIS cannot order a matrix of " + std::to_string(n) + " dofs (error " +
                               std::to_string(error) + "); is there enough memory?");

      // Positions: representatives in METIS's order, each followed by its dofs, then the last ones.
      std::vector<int> next(n_vertices), position(n);
      int count = 0;
      for (idx_t k = 0; k < n_vertices; ++k)
      {
        next[permutation[k]] = count;
        count += weight[permutation[k]];
      }
      for (int dof = 0; dof < n; ++dof)
        position[dof] = is_last[dof] ? ++count : ++next[vertex[representative[dof]]];
      return position;
    }
  } // namespace

  std::vector<int> fill_reducing_order(Mat matrix, const std::vector<unsigned int> &last)
  {
    const MPI_Comm communicator = PetscObjectComm(reinterpret_cast<PetscObject>(matrix));
    PetscInt begin = 0, end = 0, n = 0;
    MatGetOwnershipRange(matrix, &begin, &end);
    MatGetSize(matrix, &n, nullptr);

    std::vector<char> is_last(n, 0);
    for (const unsigned int dof : last)
      is_last[dof] = 1;

    // The representative of a dof: the first local dof with the same pattern (neighbours in number, so few
    // candidates).
    std::vector<int> local_representative(end - begin);
    std::vector<int> columns, other;
    {
      std::unordered_map<std::uint64_t, int> first;
      for (PetscInt row = begin; row < end; ++row)
      {
        columns_of(matrix, row, columns);
        int &representative = local_representative[row - begin];
        representative = row;
        if (is_last[row])
          continue;
        const auto [entry, is_new] = first.emplace(hash_of(columns), row);
        if (!is_new)
        {
          columns_of(matrix, entry->second, other);
          if (other == columns)
            representative = entry->second;
        }
      }
    }
    const std::vector<int> representative = gather_all(local_representative, communicator);

    // Compressed adjacency of the local representatives, without the dofs that come last.
    std::vector<int> sizes, neighbours;
    for (PetscInt row = begin; row < end; ++row)
      if (representative[row] == row && !is_last[row])
      {
        columns_of(matrix, row, columns);
        other.clear();
        for (const int c : columns)
          if (!is_last[c] && representative[c] != row)
            other.push_back(representative[c]);
        std::sort(other.begin(), other.end());
        other.erase(std::unique(other.begin(), other.end()), other.end());
        sizes.push_back(other.size());
        neighbours.insert(neighbours.end(), other.begin(), other.end());
      }
    sizes = gather_all(sizes, communicator);
    neighbours = gather_all(neighbours, communicator);
    std::vector<int> position;
    on_first_rank([&] { position = positions(representative, is_last, sizes, neighbours); }, communicator);
    return position;
  }
} // namespace vibrocontact
