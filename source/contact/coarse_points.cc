#include <vibrocontact/contact/coarse_points.h>

#include <algorithm>

namespace vibrocontact
{
  CoarsePoints::CoarsePoints(const PlacedContacts &fine) : coarse(fine), n_fine(fine.n_points())
  {
    std::vector<std::vector<unsigned int>> points;
    for (unsigned int k = 0; k < fine.all.size(); ++k)
    {
      const ContactGrid &from = fine.all[k].grid;
      ContactGrid &to = coarse.all[k].grid;
      const unsigned int along_x = from.n_x > 1 ? 2 : 1, along_y = from.n_y > 1 ? 2 : 1;
      to.n_x = (from.n_x + along_x - 1) / along_x;
      to.n_y = (from.n_y + along_y - 1) / along_y;
      to.spacing_x *= along_x;
      to.spacing_y *= along_y;
      to.x_first += 0.5 * (along_x - 1) * from.spacing_x;
      to.y_first += 0.5 * (along_y - 1) * from.spacing_y;
      for (unsigned int j = 0; j < to.n_y; ++j)
        for (unsigned int i = 0; i < to.n_x; ++i)
        {
          points.emplace_back();
          for (unsigned int own_j = along_y * j; own_j < std::min(along_y * (j + 1), from.n_y); ++own_j)
            for (unsigned int own_i = along_x * i; own_i < std::min(along_x * (i + 1), from.n_x); ++own_i)
              points.back().push_back(fine.first_point(k) + from.index(own_i, own_j));
        }
    }
    for (unsigned int c = 0; c < 3; ++c)
      for (std::vector<unsigned int> own : points)
      {
        for (unsigned int &point : own)
          point = contact_row(n_fine, c, point);
        rows.push_back(std::move(own));
      }
  }

  ContactInterface CoarsePoints::interface(const ContactInterface &fine) const
  {
    const auto mean = [&](const auto &values, const unsigned int k)
    {
      double sum = 0;
      for (const unsigned int row : rows[k])
        sum += values[row];
      return sum / rows[k].size();
    };
    ContactInterface result;
    result.contacts = coarse;
    for (unsigned int i = 0; i < coarse.n_points(); ++i)
      result.gap.push_back(mean(fine.gap, i));
    if (fine.load_jump.size() > 0)
    {
      result.load_jump.reinit(rows.size());
      for (unsigned int k = 0; k < rows.size(); ++k)
        result.load_jump[k] = mean(fine.load_jump, k);
    }
    return result;
  }

  DenseMatrix CoarsePoints::matrix(const DenseMatrix &fine) const
  {
    if (fine.m() == 0)
      return DenseMatrix();
    DenseMatrix result(rows.size());
    for (unsigned int column = 0; column < rows.size(); ++column)
      for (unsigned int row = 0; row < rows.size(); ++row)
      {
        double sum = 0;
        for (const unsigned int j : rows[column])
          for (const unsigned int i : rows[row])
            sum += fine(i, j);
        result(row, column) = sum / (rows[row].size() * rows[column].size());
      }
    return result;
  }
} // namespace vibrocontact
