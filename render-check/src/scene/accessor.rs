//! Accessors of binary glTF files. The `gltf` crate's readers panic on accessors that exceed their buffer, so the
//! bounds are checked here.

use anyhow::{Result, bail, ensure};
use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};

/// Reads positions or normals.
pub(super) fn read_vectors(accessor: &Accessor, binary: &[u8]) -> Result<Vec<[f32; 3]>> {
    ensure!(
        accessor.data_type() == DataType::F32 && accessor.dimensions() == Dimensions::Vec3,
        "they are not vectors of three 32-bit floats: export without quantisation"
    );
    let float = |at: &[u8]| f32::from_le_bytes([at[0], at[1], at[2], at[3]]);
    read_elements(accessor, binary, |e| [float(&e[0..4]), float(&e[4..8]), float(&e[8..12])])
}

/// Reads the indices of a primitive.
pub(super) fn read_indices(accessor: &Accessor, binary: &[u8]) -> Result<Vec<u32>> {
    ensure!(accessor.dimensions() == Dimensions::Scalar, "they are not single numbers");
    match accessor.data_type() {
        DataType::U8 => read_elements(accessor, binary, |e| u32::from(e[0])),
        DataType::U16 => read_elements(accessor, binary, |e| u32::from(u16::from_le_bytes([e[0], e[1]]))),
        DataType::U32 => read_elements(accessor, binary, |e| u32::from_le_bytes([e[0], e[1], e[2], e[3]])),
        other => bail!("they are {other:?}, not unsigned integers"),
    }
}

/// The elements of an accessor; `read` gets cascades of exactly one element's size.
fn read_elements<T>(accessor: &Accessor, binary: &[u8], read: impl Fn(&[u8]) -> T) -> Result<Vec<T>> {
    ensure!(accessor.sparse().is_none(), "sparse accessors are not read: export without them");
    let Some(view) = accessor.view() else {
        bail!("they have no data of their own (compressed?): export uncompressed");
    };
    ensure!(
        matches!(view.buffer().source(), gltf::buffer::Source::Bin),
        "their data is in another file: export as one .glb"
    );
    let (size, count) = (accessor.size(), accessor.count());
    let stride = view.stride().unwrap_or(size);
    ensure!(stride >= size, "they are {stride} bytes apart but {size} bytes long");
    let data = view.offset().checked_add(view.length()).and_then(|end| binary.get(view.offset()..end));
    let data = data.and_then(|data| data.get(accessor.offset()..)).unwrap_or_default();
    let needed = match count.checked_sub(1) {
        Some(last) => last.checked_mul(stride).and_then(|start| start.checked_add(size)),
        None => Some(0),
    };
    ensure!(needed.is_some_and(|needed| needed <= data.len()), "they reach beyond the file's data");
    Ok((0..count).map(|i| read(&data[i * stride..][..size])).collect())
}
