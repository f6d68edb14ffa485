// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_convex_polytope_h
#define moraine_geometry_convex_polytope_h

#include <moraine/mesh/cell_map.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace moraine
{
  /** The third component of the cross product. */
  inline double
  cross(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
  {
    return a[0] * b[1] - a[1] * b[0];
  }

  /** The vertices of a closed polygon in order. */
  using Polygon = std::vector<dealii::Point<2>>;

  /** Signed area, positive if counter-clockwise. */
  double
  polygon_area(const Polygon &polygon);

  /**
   * The numbers, from 0, of two edges (edge i goes from vertex i to the next)
   * of a closed polygon that meet elsewhere than in a common end, or fold back
   * on each other; a repeated vertex is given as twice its own number. Two
   * equal numbers of n, the number of vertices, mean a simple polygon.
   */
  std::pair<unsigned int, unsigned int>
  first_crossing(const Polygon &polygon);

  /** Of a plane polygon in space, as a container of points: its normal, twice
   * the area long. Seen against it the vertices run counter-clockwise. */
  template <typename Vertices>
  dealii::Tensor<1, 3>
  twice_area(const Vertices &vertices)
  {
    dealii::Tensor<1, 3> sum;
    for (unsigned int i = 1; i + 1 < vertices.size(); ++i)
      sum += dealii::cross_product_3d(vertices[i] - vertices[0],
                                      vertices[i + 1] - vertices[0]);
    return sum;
  }

  /** What makes up a counter-clockwise simple polygon: itself or triangles. */
  std::vector<Polygon>
  convex_parts(Polygon polygon);

  /** A plane's own coordinates; first x second = normal, of unit length. */
  struct PlaneFrame
  {
    PlaneFrame(const dealii::Point<3>     &origin,
               const dealii::Tensor<1, 3> &normal);

    dealii::Point<2>
    to_plane(const dealii::Point<3> &x) const
    {
      return {(x - origin) * first, (x - origin) * second};
    }

    dealii::Point<3>
    to_space(const dealii::Point<2> &p) const
    {
      return origin + p[0] * first + p[1] * second;
    }

    dealii::Point<3>     origin;
    dealii::Tensor<1, 3> first, second;
  };

  /** The vertices of a box. */
  template <int dim>
  CellVertices<dim>
  cell_of(const dealii::BoundingBox<dim> &box)
  {
    CellVertices<dim> vertices;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      vertices[v] = box.vertex(v);
    return vertices;
  }

  /** Volume (area in 2D) and first moment int (x - r) dV of a region about a
   * reference point r that the caller keeps. */
  template <int dim>
  struct VolumeMoments
  {
    double                 volume = 0.;
    dealii::Tensor<1, dim> first;

    /** Add @p factor times the moments of another region (same reference). */
    void
    add(const double factor, const VolumeMoments &other)
    {
      volume += factor * other.volume;
      first += factor * other.first;
    }
  };

  /**
   * A convex polygon (2D) or polyhedron (3D) with straight edges, made from a
   * cell or a box and then clipped by half spaces.
   *
   * In 3D the faces are vertex loops, counter-clockwise seen from outside. A
   * quadrilateral face that is not planar is split into four triangles about
   * the mean of its vertices: their signed volume is exactly that of the
   * bilinear face, and two cells that share the face stay watertight. Such a
   * polyhedron may be slightly non-convex; clip() stays exact for it since
   * volumes come from the divergence theorem on closed, oriented faces.
   *
   * Planes closer to a vertex than about 1e-15 times the size and distance
   * from the origin of the first polytope pass through this vertex.
   */
  template <int dim>
  class ConvexPolytope
  {
  public:
    using PointList = boost::container::small_vector<dealii::Point<dim>, 8>;

    /**
     * A cell by its vertices in deal.II's (lexicographic) order. Lengths below
     * @p round_off count as zero, if that is more than the usual. Bent faces
     * stay whole without @p split: then a plane's trace on one joins where it
     * crosses the edges, and volumes are not exact.
     */
    explicit ConvexPolytope(const CellVertices<dim> &vertices,
                            const double             round_off = 0.,
                            const bool               split     = true);

    /** The box with these two opposite corners, lower <= upper. */
    ConvexPolytope(const dealii::Point<dim> &lower,
                   const dealii::Point<dim> &upper);

    /** A convex polygon (2D), counter-clockwise. */
    static ConvexPolytope
    polygon(const PointList &vertices, const double round_off);

    /**
     * Keep the part with inward_normal . (x - point) >= 0. The normal need not
     * have unit length. The faces of what is kept that lie in the plane are
     * written to @p cut: loops as in for_each_face(), usually one (2D: the two
     * ends).
     */
    void
    clip(const dealii::Point<dim>     &point,
         const dealii::Tensor<1, dim> &inward_normal,
         std::vector<PointList>       *cut = nullptr);

    bool
    empty() const
    {
      return corner.empty();
    }

    /** Area (2D) or volume (3D); at least 0. */
    double
    volume() const
    {
      return corner.empty() ? 0. : std::max(0., moments(corner[0]).volume);
    }

    /** Centre of mass; the mean of the vertices if the volume vanishes. The
     * polytope must not be empty. */
    dealii::Point<dim>
    centroid() const;

    /** Volume and first moment about @p reference. */
    VolumeMoments<dim>
    moments(const dealii::Point<dim> &reference) const;

    /** Mean of the vertices: a cheap point inside. */
    dealii::Point<dim>
    vertex_mean() const;

    /** Largest distance of a vertex from @p point. */
    double
    radius(const dealii::Point<dim> &point) const;

    /** Lengths below this are round-off. */
    double
    tolerance() const
    {
      return round_off;
    }

    /** In 2D counter-clockwise. */
    const boost::container::small_vector<dealii::Point<dim>, 16> &
    vertices() const
    {
      return corner;
    }

    dealii::BoundingBox<dim>
    bounding_box() const
    {
      return dealii::BoundingBox<dim>(corner);
    }

    /** Call @p action(loop) for each face, a PointList counter-clockwise seen
     * from outside (2D: once, with all vertices). */
    template <typename Action>
    void
    for_each_face(const Action &action) const;

    /** Replace each vertex x by @p map(x), a rigid motion. */
    template <typename Map>
    void
    transform(const Map &map);

    /** The nearest point on the way from @p point to the centroid that lies in
     * the polytope; @p point itself if it is inside. */
    dealii::Point<dim>
    pull_inside(const dealii::Point<dim> &point) const;

  private:
    void
    add_face(const std::array<unsigned int, 4> &quadrilateral,
             const bool                         split);

    void
    set_tolerance();

    using Distances = boost::container::small_vector<double, 32>;
    using Indices   = boost::container::small_vector<unsigned short, 64>;

    void
    clip_faces(const Distances &distance, std::vector<PointList> *cut);

    void
    close_cut(std::vector<std::array<unsigned short, 2>> &rim,
              std::vector<PointList>                     *cut);

    boost::container::small_vector<dealii::Point<dim>, 16> corner;

    // the loops of the faces (2D: one) one after the other, where each ends
    Indices                                            loops;
    boost::container::small_vector<unsigned short, 16> loop_ends;

    double round_off = 0.;
  };

  template <int dim>
  template <typename Action>
  void
  ConvexPolytope<dim>::for_each_face(const Action &action) const
  {
    PointList    loop;
    unsigned int begin = 0;
    for (const unsigned int end : loop_ends)
      {
        loop.clear();
        for (unsigned int i = begin; i < end; ++i)
          loop.push_back(corner[loops[i]]);
        action(loop);
        begin = end;
      }
  }

  template <int dim>
  template <typename Map>
  void
  ConvexPolytope<dim>::transform(const Map &map)
  {
    for (auto &x : corner)
      x = map(x);
    set_tolerance();
  }
} // namespace moraine

#endif
