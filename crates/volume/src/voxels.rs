//! Voxel storage: one flat array of one of ten element types.

use std::fmt;

/// The scalar types a volume can be stored in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ElementType {
    /// Unsigned, 8 bit.
    U8,
    /// Signed, 8 bit.
    I8,
    /// Unsigned, 16 bit.
    U16,
    /// Signed, 16 bit.
    I16,
    /// Unsigned, 32 bit.
    U32,
    /// Signed, 32 bit.
    I32,
    /// Unsigned, 64 bit; exact up to 2^53.
    U64,
    /// Signed, 64 bit; exact up to 2^53.
    I64,
    /// IEEE single precision.
    F32,
    /// IEEE double precision.
    F64,
}

impl ElementType {
    /// Every element type, in the order of declaration.
    pub const ALL: [Self; 10] =
        [Self::U8, Self::I8, Self::U16, Self::I16, Self::U32, Self::I32, Self::U64, Self::I64, Self::F32, Self::F64];

    /// The size of one element in bytes: 1, 2, 4 or 8.
    pub fn size(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 => 8,
        }
    }

    /// The short name: `u8`, `i16`, `f32`, ...
    pub fn id(self) -> &'static str {
        match self {
            Self::U8 => "u8",
            Self::I8 => "i8",
            Self::U16 => "u16",
            Self::I16 => "i16",
            Self::U32 => "u32",
            Self::I32 => "i32",
            Self::U64 => "u64",
            Self::I64 => "i64",
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }

    /// The type with the given short name, if there is one.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|element| element.id() == id)
    }

    /// Whether the type is `f32` or `f64`.
    pub fn is_float(self) -> bool {
        matches!(self, Self::F32 | Self::F64)
    }
}

impl fmt::Display for ElementType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

/// A scalar that voxels can be stored as.
pub trait Element: bytemuck::Pod + PartialOrd + Send + Sync {
    /// The name of this type.
    const TYPE: ElementType;
    /// The smallest finite value.
    const LOWEST: Self;
    /// The largest finite value.
    const HIGHEST: Self;
    /// The value as `f64`; 64-bit integers are rounded beyond 2^53.
    fn to_f64(self) -> f64;
    /// The nearest value of this type; saturates.
    fn from_f64(value: f64) -> Self;
    /// Whether the value is neither NaN nor infinite; always true for integers.
    fn finite(self) -> bool;
    /// Whether the value is NaN; never for integers.
    fn nan(self) -> bool;
    /// The value with its bytes reversed.
    fn reversed(self) -> Self;
    /// Wraps an array of this type.
    fn wrap(elements: Vec<Self>) -> Voxels;
}

macro_rules! element {
    ($type:ty, $variant:ident, finite: $finite:expr, nan: $nan:expr, reversed: $reversed:expr) => {
        impl Element for $type {
            const TYPE: ElementType = ElementType::$variant;
            const LOWEST: Self = <$type>::MIN;
            const HIGHEST: Self = <$type>::MAX;
            #[inline]
            fn to_f64(self) -> f64 {
                self as f64
            }
            #[inline]
            fn from_f64(value: f64) -> Self {
                value as Self
            }
            #[inline]
            fn finite(self) -> bool {
                $finite(self)
            }
            #[inline]
            fn nan(self) -> bool {
                $nan(self)
            }
            #[inline]
            fn reversed(self) -> Self {
                $reversed(self)
            }
            fn wrap(elements: Vec<Self>) -> Voxels {
                Voxels::$variant(elements)
            }
        }
    };
    (integer $type:ident, $variant:ident) => {
        element!($type, $variant, finite: |_| true, nan: |_| false, reversed: $type::swap_bytes);
    };
}

element!(integer u8, U8);
element!(integer i8, I8);
element!(integer u16, U16);
element!(integer i16, I16);
element!(integer u32, U32);
element!(integer i32, I32);
element!(integer u64, U64);
element!(integer i64, I64);
element!(f32, F32, finite: f32::is_finite, nan: f32::is_nan, reversed: |v: f32| f32::from_bits(v.to_bits().swap_bytes()));
element!(f64, F64, finite: f64::is_finite, nan: f64::is_nan, reversed: |v: f64| f64::from_bits(v.to_bits().swap_bytes()));

/// The stored elements of a volume: x fastest, then y, then z; the channels of a voxel lie next to each other.
#[derive(Clone, PartialEq)]
pub enum Voxels {
    /// Unsigned, 8 bit.
    U8(Vec<u8>),
    /// Signed, 8 bit.
    I8(Vec<i8>),
    /// Unsigned, 16 bit.
    U16(Vec<u16>),
    /// Signed, 16 bit.
    I16(Vec<i16>),
    /// Unsigned, 32 bit.
    U32(Vec<u32>),
    /// Signed, 32 bit.
    I32(Vec<i32>),
    /// Unsigned, 64 bit.
    U64(Vec<u64>),
    /// Signed, 64 bit.
    I64(Vec<i64>),
    /// IEEE single precision.
    F32(Vec<f32>),
    /// IEEE double precision.
    F64(Vec<f64>),
}

/// Runs one expression with the elements of a [`Voxels`] as a typed `Vec`: `with_voxels!(&volume.voxels, v => v.len())`.
#[macro_export]
macro_rules! with_voxels {
    ($voxels:expr, $elements:ident => $body:expr) => {
        match $voxels {
            $crate::Voxels::U8($elements) => $body,
            $crate::Voxels::I8($elements) => $body,
            $crate::Voxels::U16($elements) => $body,
            $crate::Voxels::I16($elements) => $body,
            $crate::Voxels::U32($elements) => $body,
            $crate::Voxels::I32($elements) => $body,
            $crate::Voxels::U64($elements) => $body,
            $crate::Voxels::I64($elements) => $body,
            $crate::Voxels::F32($elements) => $body,
            $crate::Voxels::F64($elements) => $body,
        }
    };
}

impl Voxels {
    /// How many elements there are: voxels times channels.
    pub fn len(&self) -> usize {
        with_voxels!(self, elements => elements.len())
    }

    /// Whether there are no elements.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The type of every element.
    pub fn element_type(&self) -> ElementType {
        fn type_of<E: Element>(_: &[E]) -> ElementType {
            E::TYPE
        }
        with_voxels!(self, elements => type_of(elements))
    }

    /// The stored element at a flat position, before slope and intercept.
    ///
    /// # Panics
    /// When `position` is not below [`Voxels::len`], like indexing a slice.
    #[inline]
    pub fn stored(&self, position: usize) -> f64 {
        with_voxels!(self, elements => elements[position].to_f64())
    }
}

impl fmt::Debug for Voxels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Voxels({} x {})", self.len(), self.element_type())
    }
}
