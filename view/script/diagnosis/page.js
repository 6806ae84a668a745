// The page of a diagnosis, put together.

// A line of a condition: how far its heights are from the model before and after, drawn and in numbers.
function conditionCard(condition, most, press) {
  const width = 120, x = mm => width / 2 + (width / 2 - 6) * Math.min(Math.max(mm / most, -1), 1);
  const svg = drawn("svg", { viewBox: `0 0 ${width} 16`, class: "bar", "aria-hidden": "true" },
                    drawn("line", { x1: width / 2, x2: width / 2, y1: 1, y2: 15, stroke: "#9aa3ad" }),
                    drawn("line", { x1: x(condition.before_mm), x2: x(condition.after_mm), y1: 8, y2: 8, stroke: "#c3c9d0", "stroke-width": 2 }),
                    drawn("circle", { cx: x(condition.before_mm), cy: 8, r: 4.5, fill: MODELS.before }),
                    drawn("circle", { cx: x(condition.after_mm), cy: 8, r: 4.5, fill: MODELS.after }));
  const name = `${condition.fill_mm > 0 ? `${condition.fill_mm} mm, ` : ""}at (${condition.lateral_mm}, ${condition.distance_mm})`;
  return element("button", { type: "button", class: "card line", "aria-pressed": "false", title: condition.words, onclick: press },
                 element("span", {}, name), svg, element("small", {}, word("before", signed(condition.before_mm)), " → ", word("after", signed(condition.after_mm))));
}

function build(data, page) {
  const parts = layout(page), stage = new ConditionStage(data, parts.stage);
  const conditions = data.conditions, size = ({ before_mm }) => Math.abs(before_mm);
  const most = Math.max(0.5, ...conditions.map(size), ...conditions.map(({ after_mm }) => Math.abs(after_mm)));
  const range = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05].find(each => each * MM >= most) || 0.1;
  const state = { model: "before", cut: true, condition: conditions.reduce((worst, each) => (size(each) > size(worst) ? each : worst)) };

  const withEffects = data.effects.length ? `after: with ${data.effects.join(" and ")}` : "after: with the measurement's errors at their best values";
  const names = { before: "before: as it was written down", after: withEffects };
  const colouring = { title: "Points: measured minus model", scale: SIGNS_ON_WHITE, ends: [`−${range * MM} mm`, "0", `+${range * MM} mm`] };
  parts.legend.replaceChildren(...legend(colouring));
  const show = () => {
    stage.showCondition(state.condition, state.model, range);
    stage.cutAt(state.cut ? stage.axis : null);
    parts.legend.hidden = !state.condition.shot;
    document.documentElement.dataset.model = state.model;
  };
  const cards = new Map();
  const pick = condition => {
    state.condition = condition;
    for (const [other, card] of cards) card.setAttribute("aria-pressed", other === condition);
    parts.story.replaceChildren(...storyOf(stage, data, condition));
    document.documentElement.dataset.picked = conditions.indexOf(condition);
    show();
  };

  const middle = stage.axis.clone().setZ(0.45 * stage.height()), room = 5.2 * stage.height();
  const cut = tick("Cut open through the axis", state.cut, on => { state.cut = on; show(); });
  const look = (isCut, from, distance) => {
    setTick(cut, isCut);
    stage.look(from, middle, distance);
  };
  const views = {
    cup: () => look(true, stage.from(0.75, 0.55), room),
    side: () => look(true, stage.from(0.12, 0.1), 0.85 * room),
    above: () => look(false, stage.from(100, 0), room),
    sensor: () => look(false, state.condition.shot ? vector(state.condition.shot.camera) : stage.from(1, 0), room) };
  parts.buttons.append(button("Cup", views.cup), button("From the side", views.side), button("From above", views.above), button("From the sensor", views.sensor));

  const list = element("div", { class: "cards scrolled" }), lists = [];
  for (const condition of conditions) {
    if (!lists.length || lists[lists.length - 1].liquid !== condition.liquid) lists.push({ liquid: condition.liquid, made: [] });
    const card = conditionCard(condition, most, () => pick(condition));
    cards.set(condition, card);
    lists[lists.length - 1].made.push(card);
  }
  parts.panel.append(
    element("p", { class: "answer" }, data.answer),
    choice("Model", "model", names, state.model, value => { state.model = value; show(); }),
    element("fieldset", {}, element("legend", {}, "Show"), cut,
            tick("The cup's walls", true, on => stage.show(stage.bodies, on)),
            tick("The model's levels", true, on => stage.show(stage.plates, on))),
    element("p", { class: "small" }, "Fill and place of the cup; then measured minus model in mm: ", word("before", "● before"), ", ", word("after", "● after"), ". Choose a condition to see it."),
    list);
  list.append(...lists.flatMap(({ liquid, made }) => [element("h3", {}, liquid), ...made]));

  // "#view=side&model=after&condition=3", each of them if wanted.
  const wish = wishes();
  grantChoices(parts.panel, state, ["model"]);
  pick(conditions[Number(wish.get("condition") ?? NaN)] || state.condition);
  list.scrollTop = cards.get(state.condition).offsetTop - list.offsetTop - list.clientHeight / 2;
  views[granted(wish.get("view"), views, "cup")]();
}

start(build);
