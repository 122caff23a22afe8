// Typesets the equations, which mkdocs leaves as \( \) and \[ \] in elements of class arithmatex.
document.querySelectorAll(".arithmatex").forEach(element => renderMathInElement(element, {
  delimiters: [{ left: "\\[", right: "\\]", display: true }, { left: "\\(", right: "\\)", display: false }],
  throwOnError: false
}))
document.body.dataset.equations = "typeset"
