//! The modules of a crate, parsed: what each defines, imports and names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, Item, ItemMod, ItemUse, Macro, Token, UseTree};

/// A module's place in [`Crate`].
pub(crate) type Id = usize;

/// All modules of a crate; the first is its root.
pub(crate) struct Crate {
    pub(crate) modules: Vec<Module>,
}

/// A module: a file, or a block in one.
pub(crate) struct Module {
    pub(crate) name: String,
    pub(crate) parent: Option<Id>,
    pub(crate) file: PathBuf,
    pub(crate) children: BTreeMap<String, Id>,
    /// Names of the items that are defined here.
    pub(crate) items: Vec<String>,
    /// Names that are imported here, and what they stand for.
    pub(crate) imports: Vec<(String, Vec<String>)>,
    /// What all names are imported from.
    pub(crate) globs: Vec<Vec<String>>,
    /// Every path that is named here.
    pub(crate) uses: Vec<Use>,
}

/// A path in the source.
#[derive(Clone, Debug)]
pub(crate) struct Use {
    pub(crate) path: Vec<String>,
    pub(crate) line: usize,
}

/// Parses a crate from its root file on.
///
/// # Panics
///
/// Where a file is missing or is no Rust, and at a `#[path]`: files are where modules say.
pub(crate) fn parse(root: &Path, read: &dyn Fn(&Path) -> Option<String>) -> Crate {
    let mut krate = Crate { modules: Vec::new() };
    let folder = root.parent().expect("a file is in a folder");
    let id = krate.add("crate".to_owned(), None, root.to_owned());
    let items = items_of(root, read);
    krate.fill(id, &items, folder, read);
    krate
}

fn items_of(file: &Path, read: &dyn Fn(&Path) -> Option<String>) -> Vec<Item> {
    let text = read(file).unwrap_or_else(|| panic!("{} cannot be read", file.display()));
    syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", file.display())).items
}

impl Crate {
    fn add(&mut self, name: String, parent: Option<Id>, file: PathBuf) -> Id {
        let (children, items, imports) = (BTreeMap::new(), Vec::new(), Vec::new());
        let (globs, uses) = (Vec::new(), Vec::new());
        self.modules.push(Module { name, parent, file, children, items, imports, globs, uses });
        self.modules.len() - 1
    }

    /// Reads what is in a module whose child modules have their files in a folder.
    fn fill(&mut self, id: Id, items: &[Item], folder: &Path, read: &dyn Fn(&Path) -> Option<String>) {
        let mut named = Named::default();
        for item in items.iter().filter(|item| !is_for_tests(attributes(item))) {
            self.modules[id].items.extend(name_of(item));
            match item {
                Item::Mod(module) => self.add_child(id, module, folder, read),
                other => named.visit_item(other),
            }
        }
        let Named { imports, globs, uses } = named;
        let module = &mut self.modules[id];
        (module.imports, module.globs, module.uses) = (imports, globs, uses);
    }

    fn add_child(&mut self, parent: Id, module: &ItemMod, folder: &Path, read: &dyn Fn(&Path) -> Option<String>) {
        let name = module.ident.to_string();
        let in_file = &self.modules[parent].file;
        let moved = module.attrs.iter().any(|attribute| attribute.path().is_ident("path"));
        assert!(!moved, "{}: `mod {name}` has a `#[path]`", in_file.display());
        let inner = folder.join(&name);
        let (file, items) = match &module.content {
            Some((_, items)) => (in_file.clone(), items.clone()),
            None => {
                let beside = folder.join(format!("{name}.rs"));
                let file = if read(&beside).is_some() { beside } else { inner.join("mod.rs") };
                let items = items_of(&file, read);
                (file, items)
            }
        };
        let id = self.add(name.clone(), Some(parent), file);
        self.modules[parent].children.insert(name, id);
        self.fill(id, &items, &inner, read);
    }
}

/// What is compiled for unit tests alone.
fn is_for_tests(attributes: &[Attribute]) -> bool {
    let is_test = |attribute: &Attribute| attribute.parse_args::<syn::Ident>().is_ok_and(|name| name == "test");
    attributes.iter().any(|attribute| attribute.path().is_ident("cfg") && is_test(attribute))
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

fn name_of(item: &Item) -> Option<String> {
    let name = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::Type(item) => &item.ident,
        _ => return None,
    };
    Some(name.to_string())
}

/// What the code of a module imports and names, blocks of functions included.
#[derive(Default)]
struct Named {
    imports: Vec<(String, Vec<String>)>,
    globs: Vec<Vec<String>>,
    uses: Vec<Use>,
}

impl Named {
    fn import(&mut self, tree: &UseTree, before: &[String], line: usize) {
        let with = |name: &syn::Ident| [before, &[name.to_string()]].concat();
        match tree {
            UseTree::Path(path) => self.import(&path.tree, &with(&path.ident), line),
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.import(tree, before, line)),
            UseTree::Glob(_) => {
                self.globs.push(before.to_vec());
                self.uses.push(Use { path: before.to_vec(), line });
            }
            UseTree::Name(name) => self.import_as(name.ident.to_string(), with(&name.ident), line),
            UseTree::Rename(name) => self.import_as(name.rename.to_string(), with(&name.ident), line),
        }
    }

    /// `use a::{self as b}` imports a itself.
    fn import_as(&mut self, name: String, mut path: Vec<String>, line: usize) {
        let is_self = path.len() > 1 && path.last().is_some_and(|last| last == "self");
        if is_self {
            path.pop();
        }
        let name = if is_self && name == "self" { path[path.len() - 1].clone() } else { name };
        self.imports.push((name, path.clone()));
        self.uses.push(Use { path, line });
    }
}

impl<'ast> Visit<'ast> for Named {
    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        // A path that begins with `::` leads out of the crate.
        if item.leading_colon.is_none() {
            self.import(&item.tree, &[], item.span().start().line);
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        if path.leading_colon.is_none() && path.segments.len() > 1 {
            let line = path.span().start().line;
            let path = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
            self.uses.push(Use { path, line });
        }
        visit::visit_path(self, path);
    }

    /// What a macro is given is text; most of it is a list of expressions.
    fn visit_macro(&mut self, call: &'ast Macro) {
        self.visit_path(&call.path);
        if let Ok(arguments) = call.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated) {
            for argument in &arguments {
                // Parsed here, they do not live as long as the file.
                let mut inner = Self::default();
                inner.visit_expr(argument);
                self.uses.extend(inner.uses);
            }
        }
    }
}
