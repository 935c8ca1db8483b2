//! Lists the mutants of Rust sources as JSON lines: a range of bytes, the text that stands there, and one that is wrong.
//!
//! Constants, types, patterns, tests, whole numbers and what stands in macros are left alone. A mutant is an expression in the place of
//! another of the same type, a statement that is left out, or a function that returns at once.

use std::ops::Range;

use serde_json::json;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, ReturnType, Stmt, Type, UnOp};

struct Sites<'a> {
    file: &'a str,
    text: &'a str,
    function: String,
}

impl Sites<'_> {
    fn print(&self, kind: &str, range: Range<usize>, wrong: String) {
        let line = self.text[..range.start].matches('\n').count() + 1;
        let right = &self.text[range.clone()];
        let site = json!({
            "file": self.file, "line": line, "start": range.start, "end": range.end, "kind": kind,
            "function": self.function, "right": right, "wrong": wrong,
        });
        println!("{site}");
    }

    fn of(&self, node: &impl Spanned) -> &str {
        &self.text[node.span().byte_range()]
    }

    fn expression(&self, kind: &str, node: &impl Spanned, wrong: String) {
        self.print(kind, node.span().byte_range(), wrong);
    }

    fn function(&mut self, signature: &syn::Signature, block: &syn::Block) {
        let before = std::mem::replace(&mut self.function, signature.ident.to_string());
        if signature.constness.is_none() {
            for wrong in returned(&signature.output) {
                let start = block.brace_token.span.open().byte_range().end;
                self.print("return", start..start, format!("return{wrong};"));
            }
            visit::visit_block(self, block);
        }
        self.function = before;
    }
}

/// What a function may return at once, by its type.
fn returned(output: &ReturnType) -> Vec<&'static str> {
    let ReturnType::Type(_, returned) = output else { return vec![""] };
    let Type::Path(path) = &**returned else { return Vec::new() };
    let name = path.path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default();
    match name.as_str() {
        "f64" => vec![" 0.0", " 1.0"],
        "bool" => vec![" true", " false"],
        "usize" => vec![" 0", " 1"],
        "Option" => vec![" None"],
        "Vec" => vec![" Vec::new()"],
        "Local" => vec![" Local::zeros()"],
        _ => Vec::new(),
    }
}

/// True if a text is a count, as far as it can be seen: numbers with a point are equal by chance only, and what happens then is not seen.
fn counts(text: &str) -> bool {
    text.ends_with(".len()") || text.ends_with("count") || text.bytes().all(|byte| byte.is_ascii_digit())
}

/// Other operators of the same type; `ties`: it may matter what happens where both sides are equal.
fn others(op: &BinOp, ties: bool) -> &'static [&'static str] {
    match op {
        BinOp::Lt(_) if !ties => &[">"],
        BinOp::Le(_) if !ties => &[">"],
        BinOp::Gt(_) if !ties => &["<"],
        BinOp::Ge(_) if !ties => &["<"],
        BinOp::Add(_) => &["-"],
        BinOp::Sub(_) => &["+"],
        BinOp::Mul(_) => &["/"],
        BinOp::Div(_) => &["*"],
        BinOp::Lt(_) => &["<=", ">"],
        BinOp::Le(_) => &["<", ">"],
        BinOp::Gt(_) => &[">=", "<"],
        BinOp::Ge(_) => &[">", "<"],
        BinOp::Eq(_) => &["!="],
        BinOp::Ne(_) => &["=="],
        BinOp::And(_) => &["||"],
        BinOp::Or(_) => &["&&"],
        BinOp::AddAssign(_) => &["-="],
        BinOp::SubAssign(_) => &["+="],
        BinOp::MulAssign(_) => &["/="],
        BinOp::DivAssign(_) => &["*="],
        BinOp::BitOrAssign(_) => &["&="],
        _ => &[],
    }
}

/// True if an expression declares names, as `if let` does.
fn binds(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(binary) => binds(&binary.left) || binds(&binary.right),
        Expr::Paren(paren) => binds(&paren.expr),
        _ => false,
    }
}

impl<'ast> Visit<'ast> for Sites<'_> {
    fn visit_item_mod(&mut self, node: &'ast syn::ItemMod) {
        let tests = node.attrs.iter().any(|attribute| self.of(attribute).contains("test"));
        if !tests {
            visit::visit_item_mod(self, node);
        }
    }

    fn visit_item_fn(&mut self, node: &'ast syn::ItemFn) {
        self.function(&node.sig, &node.block);
    }

    fn visit_impl_item_fn(&mut self, node: &'ast syn::ImplItemFn) {
        self.function(&node.sig, &node.block);
    }

    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_type(&mut self, _: &'ast Type) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
    fn visit_generic_argument(&mut self, _: &'ast syn::GenericArgument) {}

    fn visit_expr_repeat(&mut self, node: &'ast syn::ExprRepeat) {
        self.visit_expr(&node.expr);
    }

    fn visit_expr_binary(&mut self, node: &'ast syn::ExprBinary) {
        if !binds(&node.left) && !binds(&node.right) {
            let ties = [&node.left, &node.right].into_iter().any(|side| counts(self.of(side)));
            for other in others(&node.op, ties) {
                let wrong = format!("{} {other} {}", self.of(&node.left), self.of(&node.right));
                self.expression("operator", node, wrong);
            }
        }
        visit::visit_expr_binary(self, node);
    }

    fn visit_expr_unary(&mut self, node: &'ast syn::ExprUnary) {
        if matches!(node.op, UnOp::Not(_) | UnOp::Neg(_)) {
            self.expression("sign", node, self.of(&node.expr).into());
        }
        visit::visit_expr_unary(self, node);
    }

    fn visit_expr_call(&mut self, node: &'ast syn::ExprCall) {
        // how much room a list has at first is no matter of right and wrong
        if !self.of(&node.func).ends_with("with_capacity") {
            visit::visit_expr_call(self, node);
        }
    }

    fn visit_expr_method_call(&mut self, node: &'ast syn::ExprMethodCall) {
        let receiver = self.of(&node.receiver);
        let name = node.method.to_string();
        let swap = |other: &str| {
            format!(
                "{receiver}.{other}({})",
                node.args.iter().map(|arg| self.of(arg)).collect::<Vec<_>>().join(", ")
            )
        };
        match name.as_str() {
            "min" => self.expression("bound", node, swap("max")),
            "max" => self.expression("bound", node, swap("min")),
            "any" => self.expression("quantifier", node, swap("all")),
            "all" => self.expression("quantifier", node, swap("any")),
            "abs" | "rev" => self.expression("call", node, receiver.into()),
            _ => {}
        }
        visit::visit_expr_method_call(self, node);
    }

    fn visit_expr_if(&mut self, node: &'ast syn::ExprIf) {
        if !binds(&node.cond) {
            self.expression("condition", &node.cond, format!("!({})", self.of(&node.cond)));
        }
        visit::visit_expr_if(self, node);
    }

    fn visit_expr_lit(&mut self, node: &'ast syn::ExprLit) {
        if let syn::Lit::Float(value) = &node.lit {
            let zero = value.base10_parse::<f64>().is_ok_and(|value| value == 0.0);
            let wrong = if zero { "1.0".into() } else { format!("(2.0 * {value})") };
            self.expression("number", node, wrong);
        }
    }

    fn visit_stmt(&mut self, node: &'ast Stmt) {
        if let Stmt::Expr(Expr::Assign(_) | Expr::MethodCall(_) | Expr::Call(_) | Expr::Binary(_), Some(_)) =
            node
        {
            self.print("statement", node.span().byte_range(), String::new());
        }
        visit::visit_stmt(self, node);
    }
}

fn main() {
    for file in std::env::args().skip(1) {
        let text = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{file}: {error}"));
        let parsed = syn::parse_file(&text).unwrap_or_else(|error| panic!("{file}: {error}"));
        Sites { file: &file, text: &text, function: String::new() }.visit_file(&parsed);
    }
}
