#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/matrices/dmig.h>
#include <vibrocontact/scene/nastran_cards.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    MatrixDof dof(const NastranCard &card, const std::size_t k)
    {
      const unsigned long node = card.count(k), component = card.field(k + 1).empty() ? 0 : card.count(k + 1);
      if (node == 0 || component > 6)
        throw InputError(card.where(k) + " has node " + std::to_string(node) + ", component " +
                         std::to_string(component) +
                         ": nodes count from 1, components are 1 to 6, or 0 of a scalar point.");
      return {node, component == 0 ? MatrixDof::modal : static_cast<unsigned int>(component - 1)};
    }

    DmigMatrix header(const NastranCard &card)
    {
      DmigMatrix matrix;
      matrix.source = card.source;
      matrix.name = card.field(0);
      const unsigned long form = card.count(2), type = card.count(3);
      if (form != 1 && form != 6 && form != 9)
        throw InputError(card.where(2) + " gives " + matrix.name + " the form " + std::to_string(form) +
                         ": 1 or 9 (square) or 6 (symmetric) is due.");
      if (type != 1 && type != 2)
        throw InputError(card.where(3) + " gives " + matrix.name + " the type " + std::to_string(type) +
                         ": 1 or 2 (real) is due.");
      matrix.symmetric = form == 6;
      return matrix;
    }
  } // namespace

  std::map<std::string, DmigMatrix> read_dmig(const std::string &source, const std::string &bytes)
  {
    std::map<std::string, DmigMatrix> matrices;
    for_each_card(
        source, bytes, {"DMIG"},
        [&](const NastranCard &card)
        {
          const std::string &name = card.field(0);
          if (card.field(1) == "0")
          {
            if (!matrices.emplace(name, header(card)).second)
              throw InputError(card.where() + " begins " + name +
                               " a second time: give each matrix one header.");
            return;
          }
          const auto found = matrices.find(name);
          if (found == matrices.end())
            throw InputError(card.where() + " gives a column of " + name +
                             ", which has no header before: write DMIG, " + name + ", 0, form, type.");
          const MatrixDof column = dof(card, 1);
          const std::size_t n_before = found->second.entries.size();
          for (std::size_t k = 4; k < card.fields.size(); k += 4)
            if (!card.field(k).empty())
              found->second.entries.push_back({dof(card, k), column, card.number(k + 2), card.lines[k]});
          if (found->second.entries.size() == n_before)
            throw InputError(card.where() + " gives a column of " + name +
                             " without entries: the file is cut off; write it anew.");
        });
    if (matrices.empty())
      throw InputError(source + " has no card DMIG: give the file of Nastran's matrices.");
    return matrices;
  }

  std::vector<MatrixDof> dofs_of(const std::vector<const DmigMatrix *> &matrices)
  {
    std::vector<MatrixDof> dofs;
    for (const DmigMatrix *const matrix : matrices)
      for (const DmigMatrix::Entry &entry : matrix->entries)
      {
        dofs.push_back(entry.row);
        dofs.push_back(entry.column);
      }
    std::sort(dofs.begin(), dofs.end());
    dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
    return dofs;
  }

  StoredMatrix stored(const DmigMatrix &matrix, const std::vector<MatrixDof> &dofs)
  {
    std::map<MatrixDof, unsigned int> numbers;
    for (unsigned int i = 0; i < dofs.size(); ++i)
      numbers[dofs[i]] = i;
    StoredMatrix result;
    result.source = matrix.source + ", matrix " + matrix.name;
    result.n_rows = result.n_columns = dofs.size();
    result.one_triangle = matrix.symmetric;
    const auto number = [&](const MatrixDof &dof, const unsigned int line)
    {
      const auto found = numbers.find(dof);
      if (found == numbers.end())
        throw InputError(result.source + ", line " + std::to_string(line) + ", has the dof " + dof.text() +
                         ", which the table of dofs does not have: add it.");
      return found->second;
    };
    for (const DmigMatrix::Entry &entry : matrix.entries)
      result.entries.push_back(
          {number(entry.row, entry.line), number(entry.column, entry.line), entry.value, entry.line});
    return result;
  }
} // namespace vibrocontact
