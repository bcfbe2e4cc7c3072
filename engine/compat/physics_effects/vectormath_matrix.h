// Matrix types of the overview's API, by columns. Included by vectormath.h.
#pragma once

#include "vectormath.h"

namespace sce {
namespace Vectormath {
namespace Scalar {
namespace Aos {

// 3 x 3 numbers, by columns.
class Matrix3 {
 public:
  // Zeros, or made of columns, of one number, of a rotation (angles in rad) or of scales; read and set by columns, rows and elements
  // (column, row).
  Matrix3() = default;
  Matrix3(const Vector3& c0, const Vector3& c1, const Vector3& c2) : c_{c0, c1, c2} {}
  explicit Matrix3(float all) : c_{Vector3(all), Vector3(all), Vector3(all)} {}
  explicit Matrix3(const Quat& q)
      : c_{rotate(q, Vector3::xAxis()), rotate(q, Vector3::yAxis()), rotate(q, Vector3::zAxis())} {}
  static Matrix3 identity() { return scale(Vector3(1.0f)); }
  static Matrix3 scale(const Vector3& s) {
    return Matrix3(Vector3(s[0], 0, 0), Vector3(0, s[1], 0), Vector3(0, 0, s[2]));
  }
  static Matrix3 rotation(float radians, const Vector3& unit_axis) { return Matrix3(Quat::rotation(radians, unit_axis)); }
  static Matrix3 rotation(const Quat& q) { return Matrix3(q); }
  static Matrix3 rotationX(float radians) { return Matrix3(Quat::rotationX(radians)); }
  static Matrix3 rotationY(float radians) { return Matrix3(Quat::rotationY(radians)); }
  static Matrix3 rotationZ(float radians) { return Matrix3(Quat::rotationZ(radians)); }
  // About x first, then y, then z.
  static Matrix3 rotationZYX(const Vector3& radians) {
    return Matrix3(Quat::rotationZ(radians[2]) * Quat::rotationY(radians[1]) * Quat::rotationX(radians[0]));
  }
  const Vector3& getCol(int i) const { return c_[i]; }
  const Vector3& getCol0() const { return c_[0]; }
  const Vector3& getCol1() const { return c_[1]; }
  const Vector3& getCol2() const { return c_[2]; }
  Matrix3& setCol(int i, const Vector3& v) { return c_[i] = v, *this; }
  Matrix3& setCol0(const Vector3& v) { return setCol(0, v); }
  Matrix3& setCol1(const Vector3& v) { return setCol(1, v); }
  Matrix3& setCol2(const Vector3& v) { return setCol(2, v); }
  Vector3 getRow(int i) const { return Vector3(c_[0][i], c_[1][i], c_[2][i]); }
  Matrix3& setRow(int i, const Vector3& v) { return c_[0][i] = v[0], c_[1][i] = v[1], c_[2][i] = v[2], *this; }
  float getElem(int col, int row) const { return c_[col][row]; }
  Matrix3& setElem(int col, int row, float v) { return c_[col][row] = v, *this; }
  Vector3& operator[](int i) { return c_[i]; }
  const Vector3& operator[](int i) const { return c_[i]; }
  Matrix3 operator-() const { return Matrix3(-c_[0], -c_[1], -c_[2]); }
  Matrix3& operator+=(const Matrix3& b) { return c_[0] += b[0], c_[1] += b[1], c_[2] += b[2], *this; }
  Matrix3& operator-=(const Matrix3& b) { return *this += -b; }
  Matrix3& operator*=(float s) { return c_[0] *= s, c_[1] *= s, c_[2] *= s, *this; }
  Matrix3& operator*=(const Matrix3& b);

 private:
  Vector3 c_[3];
};
// Sums, products with numbers, vectors and matrices, the transpose, the determinant, the inverse where it is not 0, and arithmetic
// by element.
inline Matrix3 operator+(Matrix3 a, const Matrix3& b) { return a += b; }
inline Matrix3 operator-(Matrix3 a, const Matrix3& b) { return a -= b; }
inline Matrix3 operator*(Matrix3 a, float s) { return a *= s; }
inline Matrix3 operator*(float s, Matrix3 a) { return a *= s; }
inline Vector3 operator*(const Matrix3& m, const Vector3& v) { return m[0] * v[0] + m[1] * v[1] + m[2] * v[2]; }
inline Matrix3 operator*(const Matrix3& a, const Matrix3& b) { return Matrix3(a * b[0], a * b[1], a * b[2]); }
inline Matrix3 transpose(const Matrix3& m) { return Matrix3(m.getRow(0), m.getRow(1), m.getRow(2)); }
inline float determinant(const Matrix3& m) { return dot(m[0], cross(m[1], m[2])); }
inline Matrix3 inverse(const Matrix3& m) {
  const float s = 1.0f / determinant(m);
  return transpose(Matrix3(cross(m[1], m[2]) * s, cross(m[2], m[0]) * s, cross(m[0], m[1]) * s));
}
inline Matrix3 absPerElem(const Matrix3& m) { return Matrix3(absPerElem(m[0]), absPerElem(m[1]), absPerElem(m[2])); }
inline Matrix3 mulPerElem(const Matrix3& a, const Matrix3& b) {
  return Matrix3(mulPerElem(a[0], b[0]), mulPerElem(a[1], b[1]), mulPerElem(a[2], b[2]));
}
inline Matrix3 crossMatrix(const Vector3& v) {
  return Matrix3(Vector3(0, v[2], -v[1]), Vector3(-v[2], 0, v[0]), Vector3(v[1], -v[0], 0));
}

inline Matrix3& Matrix3::operator*=(const Matrix3& b) { return *this = *this * b; }

// a b^T, v^T m, m times a diagonal matrix, and a diagonal matrix times m.
inline Matrix3 outer(const Vector3& a, const Vector3& b) { return Matrix3(a * b[0], a * b[1], a * b[2]); }
inline Vector3 rowMul(const Vector3& v, const Matrix3& m) { return transpose(m) * v; }
inline Matrix3 appendScale(const Matrix3& m, const Vector3& s) { return Matrix3(m[0] * s[0], m[1] * s[1], m[2] * s[2]); }
inline Matrix3 prependScale(const Vector3& s, const Matrix3& m) { return mulPerElem(m, Matrix3(s, s, s)); }

// A linear map followed by a translation.
class Transform3 {
 public:
  // Made of both, of columns, or of a rotation (angles in rad), translation or scale alone; column 3 is the translation.
  Transform3() = default;
  Transform3(const Matrix3& m, const Vector3& t) : upper_(m), translation_(t) {}
  Transform3(const Quat& q, const Vector3& t) : upper_(q), translation_(t) {}
  Transform3(const Vector3& c0, const Vector3& c1, const Vector3& c2, const Vector3& t)
      : upper_(c0, c1, c2), translation_(t) {}
  static Transform3 identity() { return Transform3(Matrix3::identity(), Vector3(0.0f)); }
  static Transform3 translation(const Vector3& t) { return Transform3(Matrix3::identity(), t); }
  static Transform3 rotation(float radians, const Vector3& unit_axis) {
    return Transform3(Matrix3::rotation(radians, unit_axis), Vector3(0.0f));
  }
  static Transform3 rotation(const Quat& q) { return Transform3(q, Vector3(0.0f)); }
  static Transform3 rotationX(float radians) { return rotation(Quat::rotationX(radians)); }
  static Transform3 rotationY(float radians) { return rotation(Quat::rotationY(radians)); }
  static Transform3 rotationZ(float radians) { return rotation(Quat::rotationZ(radians)); }
  static Transform3 rotationZYX(const Vector3& radians) { return Transform3(Matrix3::rotationZYX(radians), Vector3(0.0f)); }
  static Transform3 scale(const Vector3& s) { return Transform3(Matrix3::scale(s), Vector3(0.0f)); }
  const Matrix3& getUpper3x3() const { return upper_; }
  const Vector3& getTranslation() const { return translation_; }
  Transform3& setUpper3x3(const Matrix3& m) { return upper_ = m, *this; }
  Transform3& setTranslation(const Vector3& t) { return translation_ = t, *this; }
  const Vector3& getCol(int i) const { return i < 3 ? upper_[i] : translation_; }
  Transform3& setCol(int i, const Vector3& v) { return (i < 3 ? upper_[i] : translation_) = v, *this; }
  const Vector3& getCol0() const { return upper_[0]; }
  const Vector3& getCol1() const { return upper_[1]; }
  const Vector3& getCol2() const { return upper_[2]; }
  const Vector3& getCol3() const { return translation_; }
  Transform3& setCol0(const Vector3& v) { return setCol(0, v); }
  Transform3& setCol1(const Vector3& v) { return setCol(1, v); }
  Transform3& setCol2(const Vector3& v) { return setCol(2, v); }
  Transform3& setCol3(const Vector3& v) { return setCol(3, v); }
  Vector4 getRow(int i) const { return Vector4(upper_[0][i], upper_[1][i], upper_[2][i], translation_[i]); }
  float getElem(int col, int row) const { return getCol(col)[row]; }
  Transform3& setElem(int col, int row, float v) { return (*this)[col][row] = v, *this; }
  Vector3& operator[](int i) { return i < 3 ? upper_[i] : translation_; }
  const Vector3& operator[](int i) const { return getCol(i); }
  Transform3& operator*=(const Transform3& b);

 private:
  Matrix3 upper_;
  Vector3 translation_;
};
// A vector is turned, a point is moved too; the product does the right one first. orthoInverse() is for rotations.
inline Vector3 operator*(const Transform3& t, const Vector3& v) { return t.getUpper3x3() * v; }
inline Point3 operator*(const Transform3& t, const Point3& p) {
  return Point3(t.getUpper3x3() * Vector3(p) + t.getTranslation());
}
inline Transform3 operator*(const Transform3& a, const Transform3& b) {
  return Transform3(a.getUpper3x3() * b.getUpper3x3(), a.getUpper3x3() * b.getTranslation() + a.getTranslation());
}
inline Transform3 inverse(const Transform3& t) {
  const Matrix3 m = inverse(t.getUpper3x3());
  return Transform3(m, -(m * t.getTranslation()));
}
inline Transform3 orthoInverse(const Transform3& t) {
  const Matrix3 m = transpose(t.getUpper3x3());
  return Transform3(m, -(m * t.getTranslation()));
}

inline Transform3& Transform3::operator*=(const Transform3& b) { return *this = *this * b; }

// 4 x 4 numbers, by columns.
class Matrix4 {
 public:
  // Zeros, or made of columns, of a rotation (angles in rad) and translation, of scales or of one number; read and set by columns,
  // rows and elements (column, row).
  Matrix4() = default;
  Matrix4(const Vector4& c0, const Vector4& c1, const Vector4& c2, const Vector4& c3) : c_{c0, c1, c2, c3} {}
  Matrix4(const Matrix3& m, const Vector3& t) : c_{Vector4(m[0]), Vector4(m[1]), Vector4(m[2]), Vector4(t, 1.0f)} {}
  Matrix4(const Quat& q, const Vector3& t) : Matrix4(Matrix3(q), t) {}
  explicit Matrix4(const Transform3& t) : Matrix4(t.getUpper3x3(), t.getTranslation()) {}
  static Matrix4 identity() { return Matrix4(Matrix3::identity(), Vector3(0.0f)); }
  static Matrix4 translation(const Vector3& t) { return Matrix4(Matrix3::identity(), t); }
  static Matrix4 rotation(const Quat& q) { return Matrix4(q, Vector3(0.0f)); }
  static Matrix4 scale(const Vector3& s) { return Matrix4(Matrix3::scale(s), Vector3(0.0f)); }
  static Matrix4 rotation(float radians, const Vector3& unit_axis) { return rotation(Quat::rotation(radians, unit_axis)); }
  static Matrix4 rotationX(float radians) { return rotation(Quat::rotationX(radians)); }
  static Matrix4 rotationY(float radians) { return rotation(Quat::rotationY(radians)); }
  static Matrix4 rotationZ(float radians) { return rotation(Quat::rotationZ(radians)); }
  explicit Matrix4(float all) : c_{Vector4(all), Vector4(all), Vector4(all), Vector4(all)} {}
  const Vector4& getCol(int i) const { return c_[i]; }
  const Vector4& getCol0() const { return c_[0]; }
  const Vector4& getCol1() const { return c_[1]; }
  const Vector4& getCol2() const { return c_[2]; }
  const Vector4& getCol3() const { return c_[3]; }
  Matrix4& setCol(int i, const Vector4& v) { return c_[i] = v, *this; }
  Matrix4& setCol0(const Vector4& v) { return setCol(0, v); }
  Matrix4& setCol1(const Vector4& v) { return setCol(1, v); }
  Matrix4& setCol2(const Vector4& v) { return setCol(2, v); }
  Matrix4& setCol3(const Vector4& v) { return setCol(3, v); }
  Vector4 getRow(int i) const { return Vector4(c_[0][i], c_[1][i], c_[2][i], c_[3][i]); }
  Matrix4& setUpper3x3(const Matrix3& m) {
    for (int i = 0; i < 3; ++i) c_[i].setXYZ(m[i]);
    return *this;
  }
  Matrix4& setTranslation(const Vector3& t) { return c_[3].setXYZ(t), *this; }
  float getElem(int col, int row) const { return c_[col][row]; }
  Matrix4& setElem(int col, int row, float v) { return c_[col][row] = v, *this; }
  Vector4& operator[](int i) { return c_[i]; }
  const Vector4& operator[](int i) const { return c_[i]; }
  Matrix3 getUpper3x3() const { return Matrix3(c_[0].getXYZ(), c_[1].getXYZ(), c_[2].getXYZ()); }
  Vector3 getTranslation() const { return c_[3].getXYZ(); }

 private:
  Vector4 c_[4];
};
// Products and sums. Vectors have w = 0, points w = 1.
inline Vector4 operator*(const Matrix4& m, const Vector4& v) {
  return m[0] * v[0] + m[1] * v[1] + m[2] * v[2] + m[3] * v[3];
}
inline Vector4 operator*(const Matrix4& m, const Vector3& v) { return m * Vector4(v); }
inline Vector4 operator*(const Matrix4& m, const Point3& p) { return m * Vector4(p); }
inline Matrix4 operator*(const Matrix4& a, const Matrix4& b) { return Matrix4(a * b[0], a * b[1], a * b[2], a * b[3]); }
inline Matrix4 operator*(const Matrix4& a, const Transform3& b) { return a * Matrix4(b); }
inline Matrix4 operator*(const Matrix4& a, float s) { return Matrix4(a[0] * s, a[1] * s, a[2] * s, a[3] * s); }
inline Matrix4 operator*(float s, const Matrix4& a) { return a * s; }
inline Matrix4 operator+(const Matrix4& a, const Matrix4& b) { return Matrix4(a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]); }
inline Matrix4 operator-(const Matrix4& a, const Matrix4& b) { return Matrix4(a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]); }
// Of a matrix whose last row is (0, 0, 0, 1).
inline Matrix4 affineInverse(const Matrix4& m) { return Matrix4(inverse(Transform3(m.getUpper3x3(), m.getTranslation()))); }
inline Matrix4 orthoInverse(const Matrix4& m) { return Matrix4(orthoInverse(Transform3(m.getUpper3x3(), m.getTranslation()))); }
// Rows become columns.
inline Matrix4 transpose(const Matrix4& m) {
  Matrix4 t;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) t[i][j] = m[j][i];
  return t;
}
// By blocks [A, b; c, d] of 3 and 1 (Schur's complement); of a matrix whose upper 3 x 3 block has an inverse.
inline Matrix4 inverse(const Matrix4& m) {
  const Matrix3 a = inverse(m.getUpper3x3());
  const Vector3 b = a * m.getTranslation(), c = rowMul(m.getRow(3).getXYZ(), a);
  const float d = 1.0f / (m[3][3] - dot(c, m.getTranslation()));
  const Matrix3 upper = a + outer(b, c) * d;
  return Matrix4(Vector4(upper[0], -d * c[0]), Vector4(upper[1], -d * c[1]), Vector4(upper[2], -d * c[2]), Vector4(-d * b, d));
}

}  // namespace Aos
}  // namespace Scalar
}  // namespace Vectormath
}  // namespace sce
