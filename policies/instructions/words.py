"""Words of instructions by what they mean, as patterns over a plain text.

Levels: 2 says how to grip, 1 gives a reason for it. A stronger word outranks a weaker one
(``policies.instructions.manner``). Patterns are tried in their order; a match is taken out.
"""

from __future__ import annotations

# --- manner ------------------------------------------------------------------------------------

DELICATE = (
    r"(?:egg(?:s|shells?)?|quails? eggs?|soap bubbles?|bubbles?|bab(?:y|ies)|new ?borns?|infants?|(?:baby |little |tiny |wounded |injured )*"
    r"(?:birds?|chicks?|sparrows?|hummingbirds?|ducklings?|kittens?|pupp(?:y|ies)|mouse|hamsters?)|butterfl(?:y|ies)|moths?|feathers?|"
    r"snowflakes?|glass|crystals?|china|porcelain|(?:wet )?tissue(?: paper)?|petals?|roses?|flowers?|orchids?|cobwebs?|"
    r"spider'?s? ?webs?|gossamer|dandelions?|souffl[eé]s?|jewels?|gems?|treasures?|heirlooms?|antiques?|clouds?|"
    r"mousse|jelly|custard|wet paper|paper|contact lens(?:es)?|wafers?|crisps?|eyeballs?|lace|silk|faberg[eé]\w*|"
    r"(?:light ?)?bulbs?|raw egg|dragonfl(?:y|ies)|(?:fresh )?cream|meringues?|whisper|ghosts?|bomb|grenade|mine|priceless \w+|it were (?:nothing|air))"
)
STURDY = (
    r"(?:rocks?|stones?|bricks?|vices?|vises?|bulldogs?|pit ?bulls?|hammers?|wrench(?:es)?|boas?|bears?|gorillas?|steel|"
    r"clamps?|handshakes?|climbers?|crab|lobster|eagle|tennis balls?|golf balls?|potato(?:es)?|turnips?|"
    r"crowbars?|anchors?|pros?|champions?|wrestlers?|rugby ball|football|barnacles?|limpets?|grim death|glue|"
    r"your life depend\w*|there is no tomorrow|you mean (?:it|business)|an? (?:man|boss))"
)
_SIMILE = r"(?:(?:just )?like|as if|as though|as you would|imagine|pretend|think of it as|consider it)(?: (?:to be|to hold|to handle|holding|handling|touching|picking|lifting|carrying|cradling|up|raw|fresh|premature|newly|just|it|it is|it were|it was|were|was|is|made|of|a|an|the|your|some|very|it's|you|hold|handle|grip|grab|carrying|carry|gripping|had|have|with|made from))*"

NEUTRAL: tuple[str, ...] = (
    r"\b(?:do not|never) (?:forget|hesitate|be (?:afraid|scared)|neglect|fail) to\b",
    r"\b(?:do not|never) (?:be )?(?:forget|hesitate)\b",
    r"\bfeel free to\b|\b(?:be|make) sure (?:to|that|you|it)?\b|\bremember to\b",
    r"\bno (?:problem|worries|rush|hurry|doubt|matter what|kidding|joke|sweat)\b|\bnot (?:a problem|bad)\b",
    r"\bnever mind (?:what|that|the|how|who|why)\b[^,.;]*",
    r"\b(?:no|nothing|not|none) more than\b(?= (?:a|the|is|you|what|it|kiss|touch|caress|stroke|brush|hold)\b)|\bnothing but\b|\bnone other than\b|\bnothing (?:if|short of)\b",
    r"\b(?:would|will) not (?:hurt|harm|kill you|be amiss)(?: to| if you| you to)?\b|\bwould it (?:kill|hurt) you to\b",
    r"\bnot only\b|\bno less\b(?! than)|\bwhy not\b|\bi do not (?:care|mind)\b(?= (?:who|how you|what))",
    r"\b(?:is|are|was) not (?:it|that|you)\b\?|\bif (?:you do not|i'm not|i am not)\b[^,.;]*mind\w*",
    r"\bi would not (?:want|like|have|ask)(?: (?:you|it))? (?:to be |be |to )?(?:anything|any other way|otherwise)\b(?! but| other)",
    r"\bno matter\b|\bnot to mention\b|\bif not\b|\bwhy do not (?:you|we)\b|\bcan not wait\b|\bcould not care less\b",
    r"\byou (?:big |little |total )?(?:wimp|softie|softy|weakling|chicken|coward|brute|muppet|numpty)\b",
    r"\b(?:i )?bet (?:that )?you can not\b|\bwould you mind\b|\bdo you mind\b|\bif you (?:do not )?mind\b|\bneither (?:more nor less|less nor more)(?: force| grip| pressure)?(?: than \w+)?\b|\b(?:to|in|into|against|towards?) the (?:sun)?light\b|\bneither (?:too |more )?(?:hard|soft|firm|gent|light|tight|loose|strong|weak)\w* nor (?:too |more )?\w+(?: than \w+)?\b|\bpop (?:it|that|this|the \w+)(?: \w+)? (?:in|into|on|onto|over|up)\b|\bthe ripe one\b|\bthat (?:fell|dropped|slipped|rolled) (?:off|on|from)\b",
    r"\b(?:light|lightly|hard|soft|strong|tight|firm|gentle|tough|rough|delicate)(?:ly)? (?:speckled|red|pink|green|blue|brown|colou?red|plastic|metal|wooden|tray|table|surface|shell|case|cover|floor|leather|smell\w*|scent\w*|taste|flavou?r|breeze|slope|cheese|rain|shade|shadow)\b|\bcrushed ice\b|\bstrong(?:ly)? smell\w*",
    r"\bsoft fruits?\b|\bsoft (?:mat|mats|bed|foam|fingers?|pads?|gripper|toys?|launch)\b|\bsoftware\b|\bhard(?:ware| disk| drive| copy| limit| deadline| hat|ly)\b(?<!hardly)|\bhigh[- ]?light\b",
    r"\bcareful observation\b|\bin the light\b|\bunder the light\b|\blight (?:bulb|switch|box)\b|\bred light\b|\bgreen light\b|\btraffic light\b|\bfirm(?:s|ware)\b|\bour firm\b",
    r"\bstrong coffee\b|\btight (?:schedule|deadline|budget)\b|\bhard (?:day|time|work|question)\b|\beasy (?:task|job|one|peasy)\b|\bhard to (?:say|tell|believe)\b",
)
"""Phrases with words of manner or denial that mean none."""

SOFT_2: tuple[str, ...] = (
    r"\b(?:(?:well|far|way|a (?:bit|little)|somewhat|stay|keep(?: it)?|go|force|pressure|grip|just) )(?:below|under|beneath) (?:the |your |its )?(?:nominal|normal|usual|standard|average|default|typical|task)(?: one| force| grip| band)?\b(?! (?:conditions|circumstances|rules))|\bfinger[- ]tight\b(?: at most)?|\batraumatic(?:ally)?\b|\bdolce\b|\bchill (?:with|on|out)\b",
    rf"\b(?:grip|touch|grasp|hold|squeeze|fingers|pressure|hand)(?: \w+){{0,2}} (?:be|of|as) {DELICATE}\b|\b{DELICATE}(?:[- ]\w+)? (?:pressure|grip|touch|hold|fingers|squeeze|grasp)\b",
    rf"\b{_SIMILE} {DELICATE}\b|\b{DELICATE}[- ]like\b|\bkiss(?:ing|es)?\b",
    r"\b(?:can|could) (?:not|never|hardly) (?:\w+ ){0,4}?(?:too|over) ?(?:gentl[ey]|soft(?:ly)?|light(?:ly)?|careful(?:ly)?|delicate(?:ly)?|cautious(?:ly)?|tender(?:ly)?)\b",
    r"\b(?:kid|velvet|silk|white|cotton|soft|baby|gentle|satin)(?: cotton| silk| kid)? gloves?\b|\bcotton wool\b",
    r"\b(?:go|going|take (?:it|things)|nice and|be|real|easy) easy\b|\beasy does it\b|\beasy now\b|\beasy(?=[,.! ]*$| on\b|,)",
    r"\b(?:back|ease|let|lay|slack|throttle|dial|tone|turn(?! off| it off| the \w+ off)|bring|scale|cut|knock|wind|rein|calm) ?(?:it |things |that |the (?:force|grip|pressure|squeeze|power|squeezing|strength) ?|your (?:grip|squeeze|force) ?|some of (?:it|the (?:force|pressure)) ?|the grip force ?)?(?:a bit |a little |a notch |a touch |right |way |slightly )?(?:off|(?<=ease )up|(?<=let )up|(?<=lay )up|down|back(?! (?:on|to|at|in|where|up)))\b(?! and(?: \w+)? let go)(?! (?:on it|carefully))",
    r"\b(?:drop|lower|reduce|decrease|lessen|lighten|soften|relax|loosen|slacken|diminish|minimi[sz]e|moderate|shave|trim)(?:ed|ing|en)? (?:\w+ ){0,4}?(?:force|grip(?:ping)?|pressure|squeeze|squeezing|hold|strength|power|effort|tension|touch|clamp|fingers?|hand|intensity|it)\b",
    r"\brelease (?:some|a bit|a little|part|half)\b(?: of)?(?: the| that| your)?(?: pressure| force| grip| tension)?",
    r"\bgive it (?:some|a (?:bit|little)(?: of)?|more) (?:slack|room|air|breathing\w*)\b|\blet it breathe\b",
    r"\b(?:only |just )(?:just )?(?:enough|what)(?: \w+){0,3}? (?:force |pressure |grip |squeeze |strength )?(?:to|so|that|for|is needed|needed|as)\b|\bonly just\b|\bjust (?:barely|about)\b|\bjust enough\b",
    r"\b(?:no|not) (?:harder|firmer|tighter|more(?: \w+)?) than (?:is |absolutely |strictly |really |you )*(?:necessary|needed|required|have to|need to|must|need)\b",
    r"\bonly as (?:hard|firmly|tightly|much)(?: \w+)? as (?:is |absolutely |you )*(?:necessary|needed|required|have to|need to|must|need)\b",
    r"\b(?:barely|hardly|scarcely|merely|ever so)(?: \w+)?\b",
    r"\b(?:min(?:imum|imal)|least|smallest|lowest|lightest|gentlest|softest|tiniest|faintest|slightest|weakest|tenderest|bare minimum|smallest possible)\b(?: \w+){0,2}? ?(?:force|pressure|grip|touch|squeeze|possible|amount|hold|effort|strength|contact)?\b",
    r"\bas little (?:\w+ )?(?:as|of)\b|\b(?:very |so |too |only a )?(?:little|low|tiny|small|slight|mild|faint|modest) (?:bit of |amount of |grip(?:ping)? |gripping |clamping )?(?:force|pressure|squeeze|strength|power|pinch|touch)\b|\bnot (?:too |so |very |that )?much (?:force|pressure|grip|strength|squeeze|power)\b",
    r"\b(?:less|lower|smaller|weaker|lesser|reduced|fewer|a fraction of) (?:of )?(?:the |your |that )?(?:usual |normal |grip |grip(?:ping)? |squeezing |clamping |finger )*(?:force|pressure|grip|squeeze|squeezing|strength|power|muscle|oomph|effort|clamp|pinch|tension|newtons?|might|welly|vigou?r|enthusiasm|zeal|gusto|energy|eagerness|conviction)\b",
    r"\b(?:not|no need to|stop|quit|without) (?:press|squeez|push|grip|clamp|pinch|hold)\w*(?: down| on| it| that| this| the \w+)*(?: so| too| that| as| very)? much\b|\b(?:ease|let|lay) up\b",
    r"\bless than (?:the |your |its )?(?:usual|normal|standard|full|default)(?: \w+)?",
    r"\b(?:less)(?=[,.! ]*$| than| of| please| this| next| on it)",
    r"\bslack(?:er|en)?\b|\bfeather(?:y|[- ]?light(?:ly)?|weight)?\b|\bwhisper(?:[- ]?(?:light|soft|quiet))?(?:ly)?\b|\bsoft(?:ly|er|est|ness|ie)?\b|\bsofty\b",
    r"\bgent(?:le|ly|ler|lest|leness|lenes)\b|\bungently\b|\blight(?:ly|er|est|ness|[- ](?:handed(?:ly)?|touch|fingered|hand))?\b(?! bulb)|\bdelica(?:te(?:ly)?|cy|tesse)\b|\btender(?:ly|ness)?\b",
    r"\bloose(?:ly|r|n)?\b|\bweak(?:ly|er)?\b|\bmild(?:ly|er)?\b|\bfaint(?:ly)?\b|\btimid(?:ly|ity)?\b|\btentative(?:ly)?\b|\bgingerly\b|\bkindness\b|\bkind(?= to\b)|\bbe kind\b|\bshy(?:ly)?\b|\bmeek(?:ly)?\b|\blimp(?:ly)?\b|\bcoy(?:ly)?\b|\bfeeb(?:le|ly)\b|\bflimsy\b|\bhalf-?hearted(?:ly)?\b|\bdaint(?:y|ily)\b|\bdeft(?:ly)?\b|\blovingly\b|\baffectionate(?:ly)?\b|\bsubtl[ey]\b|\bpianissimo\b|\bpiano\b|\bsweetly\b|\btame(?:ly)?\b|\bwimp(?:y|ish)?\b",
    r"\bcaress\w*\b|\b(?:baby|babying|coddl(?:e|ing)|pamper(?:ing)?|mollycoddl\w+|cradl(?:e|ing)|cosset|cuddl\w+|nurs(?:e|ing)|strok\w+)\b",
    r"\bbutter(?:fly|y) ?(?:touch|grip|fingers|hands?)?\b|\bvelvet(?:y)?\b|\bsilky\b|\bcotton[- ]?soft\b|\bplush\b",
    r"\brelax(?:ed)?\b|\bloosen(?:ed|ing)?\b|\blighten\b|\bsoften\b|\bslow down on the\b|\bmercy\b|\bmerciful(?:ly)?\b|\bTLC\b|\btlc\b",
)
FIRM_2: tuple[str, ...] = (
    r"\b(?:(?:well|far|way|a (?:bit|little)|somewhat|stay|keep(?: it)?|go|force|pressure|grip|just) )(?:above|over|beyond) (?:the |your |its )?(?:nominal|normal|usual|standard|average|default|typical|task)(?: one| force| grip| band)?\b|\bchoke up\b|\b(?:grip|grasp|hold|squeeze|fist|hand)(?: \w+){0,2} (?:be|of) (?:iron|steel)\b",
    r"\bmore than (?:the |your |its )?(?:usual|normal|standard|default)(?: \w+)?",
    rf"\b{_SIMILE} {STURDY}\b|\b{STURDY}[- ]like\b|\b(?:as if|as though|like) (?:some|any)(?:body|one|thing)\b.*\b(?:pull\w*|steal\w*|tak\w+|snatch\w*|tear\w*|yank\w*|wrench\w*|rob\w*)\b[^,.;]*",
    r"\b(?:do not|never|without) hold(?:ing)? (?:anything )?back\b|\bdo not be (?:so )?(?:shy|polite|coy)\b|\bno holding back\b",
    r"\b(?:bear|clamp|press|bite|lean|crank|knuckle|dig|buckle|double|squeeze)(?:ing)? (?:down|in|into)\b(?: on)?|\bclamp (?:on|tight|hard)\b",
    r"\b(?:dial|turn|crank|ramp|step|beef|jack|bump|push|amp|pump|firm|tighten|toughen|up|man|notch|rev)(?: it| things| the (?:force|grip|pressure|squeeze|power|squeezing|strength|grip force)| your (?:grip|squeeze|force))? (?:right |way |a bit |a little )?up\b|\bup the (?:force|grip|pressure|squeeze|ante)\b",
    r"\b(?:increase|raise|boost|strengthen|tighten|intensify|elevate|amplify|heighten|add)(?:d|ing)? (?:\w+ ){0,4}?(?:force|grip(?:ping)?|pressure|squeeze|squeezing|hold|strength|power|effort|tension|clamp|muscle|newtons?)\b|\btighten(?:ed|ing)?\b",
    r"\b(?:more|extra|additional|greater|higher|bigger|much|plenty of|lots of|a lot of|heaps of|loads of|a good deal of|serious|considerable|substantial|high|strong|full|maximum|max|great|ample|all (?:your|the|of your)|some (?:real|serious|more|extra)|some) (?:of )?(?:the |your |that |a )?(?:usual |grip(?:ping)? |squeezing |clamping |finger |bit of )*(?:force|pressure|grip|gripping|squeeze|squeezing|strength|power|muscle|oomph|welly|effort|clamp|pinch|tension|might|elbow grease|beef|conviction|bite|purchase|hold|grunt|traction|vigou?r|enthusiasm|zeal|gusto|energy)\b",
    r"\b(?:squeeze|grip|press|clamp|hold|pinch|push|close)(?: \w+){0,3}? (?:(?:a )?(?:bit|little|lot|tad|touch|hair|smidge\w*|notch) )?more\b(?! (?:~|gent|soft|light|care|loos|tender|delic|caut|slow))|\b(?:a bit|a little|a lot|a notch|a touch|much) more(?=[,.! ]*$)|\bmore(?=[,.! ]*$)",
    r"\bfirm(?:ly|er|est|ish)?\b|\btight(?:ly|er|est|en)?\b|\bhard(?:er|est)?\b(?! (?:as a )?(?:boiled|fruit))|\bstrong(?:ly|er|est)?\b|\bforce(?:ful(?:ly)?|fully)\b|\bsolid(?:ly)?\b|\bsturd(?:y|ily)\b|\bsnug(?:ly)?\b|\bvigorous(?:ly)?\b|\brobust(?:ly)?\b|\bpowerful(?:ly)?\b|\bvice-?like\b|\bvise-?like\b|\biron (?:grip|fist|hand|hold)\b|\bdeath grip\b|\bbear hug\b|\bstern(?:ly)?\b|\brigid(?:ly)?\b|\btenacious(?:ly)?\b|\bassertive(?:ly)?\b|\baggressive(?:ly)?\b|\bconfident(?:ly)?\b|\bresolute(?:ly)?\b|\bdecisive(?:ly)?\b|\bbold(?:ly|er)?\b|\brough(?:ly|er)?\b|\bbrutal(?:ly)?\b|\bmuscular\b|\bhefty\b|\bheavy[- ]?(?:handed(?:ly)?|duty|grip)\b|\bferocious(?:ly)?\b|\bfierce(?:ly)?\b|\bvehement(?:ly)?\b|\bstiff(?:ly|er)?\b|\bmight(?:y|ily)\b|\bfast grip\b|\bfortissimo\b|\bforte\b|\bstout(?:ly)?\b|\bmacho\b|\bbeefy\b|\bfull[- ]blooded\b|\bunyielding\b|\bhammer[- ]?(?:grip|hold)?\b|\bbite down\b",
    r"\bwith (?:conviction|might|vigou?r|determination|gusto|authority|purpose|strength|force|muscle|power|a will|intent)\b|\bby force\b|\blike you mean it\b|\bfor dear life\b|\bhang on tight\w*\b|\bwhite knuckles?\b|\bget a grip\b|\bput (?:some|your|more) (?:\w+ )?(?:back|muscle|beef|elbow\w*|welly|effort|weight|shoulder) (?:grease )?(?:into|in|behind)\b|\bgive it some (?:welly|beef|stick|oomph|grip|muscle|clout|grunt)\b|\bpower grip\b|\block (?:it )?(?:down|in|on|tight)\b|\bno (?:slack|wiggle room|play|give)\b|\bwhite[- ]knuckle\w*\b|\bstrong-?arm\b|\bstrength\b|\bgrippy\b|\bgrippier\b|\bsqueezier\b|\bgrip it good\b|\bmuscle\b|\bnail it down\b|\bdig in\b",
)
SOFT_1: tuple[str, ...] = (
    r"\b(?:bruis(?:es?|ing)|damages?|marks?|dents?|squashing|crushing|blemish(?:es)?) (?:is|are|was|were|means?|costs?|ruins?|spoils?)(?: a| the)? (?:bad|unacceptable|forbidden|money|failure|problem|enemy|ruin\w*)\b",
    r"\b(?:better|rather|sooner|prefer(?: to)?|i'd rather)(?: \w+){0,2} (?:drop|lose|miss|let it (?:fall|go|slip))(?: it)? than (?:bruise|squash|crush|mark|damage|hurt|break|dent)(?: it)?\b",
    r"\b(?:does not|do not|will not|would not) (?:really )?(?:matter|care|mind)(?: \w+){0,2} if (?:it|you) (?:falls?|drops?|slips?|slides?|lose)\b(?: it)?",
    r"\bcare(?:ful(?:ly|lest)?)?\b(?! about| less| for| if| whether| what| how)|\bcaution\b|\bcautious(?:ly)?\b|\b(?:mind|watch|beware)(?: \w+)?(?= the| its| how|,|$| not)|\bhandle with\b|\bwary\b|\bwarily\b|\bthoughtful(?:ly)?\b|\brespect(?:ful(?:ly)?)?\b",
    r"\bfragile\b|\bfrail\b|\b(?:over|super|very|so|quite|really|fully|dead|perfectly|extra|too|extremely|already|nice and|getting) ?-?ripe\b|\boverripe\b|\bmush(?:y)?\b|\bsquishy\b|\bjuicy\b|\bvulnerable\b|\bsensitive\b|\bthin[- ]?skin(?:ned)?\b|\b(?:thin|tender|delicate) skin\b|\bprecious\b|\bpriceless\b|\bvaluable\b|\bexpensive\b|\bprize(?:d|-winning)?\b|\bbrittle\b|\bbreakable\b|\bcrushable\b|\bsoggy\b|\brotting\b|\bpast its best\b|\bsore\b|\bpuls?py\b",
    r"\b(?:in one piece|intact|unharmed|unhurt|unblemished|unmarked|undamaged|unbruised|flawless(?:ly)?|pristine|spotless|picture[- ]perfect|immaculate|mint condition|perfect condition|unscathed|uncrushed|unsquashed|whole)\b",
    r"\bwedding cake\b|\bphoto ?shoot\b|\bshow(?:piece|case)\b|\bcompetition\b(?= berry| fruit|,|$)",
    r"\b(?:bruis|squash|squish|crush|mash|damag|mark|dent|blemish|scratch|burst|split|crack|mangl|puree|pulp|hurt|harm|break|broke|tear|tore|ripp|ruin|spoil|smash|smush|mush|flatten|scar|maul|pierc|punctur|injur|nick|scuff|smear|bleed|leak|ooz|juic)(?:\w*)\b",
)
FIRM_1: tuple[str, ...] = (
    r"\b(?:bruis(?:es?|ing)|damages?|marks?|dents?|blemish(?:es)?|looks)(?: \w+){0,2}? (?:do(?:es)? not|will not|would not|are not|is not) (?:really )?(?:matter|count|(?:be )?(?:important|a problem|an issue|a concern))\b",
    r"\b(?:never mind|ignore|do not (?:care|worry|fret|mind)|no worries|not worried|forget)(?: about| if| the| a| any| it| gets?)*(?: the| a| few| some)? (?:bruis\w*|damag\w*|marks?|dents?|squash\w*|crush\w*|hurting|harming)\b(?: it)?",
    r"\b(?:it|this|that|berry|fruit|one|thing|they|these|skin|strawberry)(?: \w+)? (?:will not|does not|do not|can not(?: be)?|would not|is not going to|hardly|never|is unlikely to) (?:easily )?(?:bruise\w*|squash\w*|crush\w*|damage\w*|mark|dent|burst|split|crack|break|hurt|mind|be (?:bruised|crushed|squashed|damaged|hurt|harmed|broken)|complain|tear)\b",
    r"\b(?:impossible|hard|difficult|tough) to (?:bruise|squash|crush|damage|mark|dent|burst|hurt|break)\b|\b(?:un|in)(?:breakable|bruisable|crushable|destructible|squashable)\b|\bnothing (?:to|can|will|could) (?:be )?(?:damage\w*|bruise\w*|break|hurt|crush\w*|burst)\b",
    r"\b(?:better|rather|sooner|prefer(?: to)?|i'd rather)(?: \w+){0,2} (?:bruise|squash|crush|mark|damage|hurt|dent)(?: it)? than (?:drop|lose|miss|let it (?:fall|go|slip))(?: it)?\b",
    r"\b(?:can|could|will) (?:definitely |easily |certainly |surely )?(?:take|handle|stand|withstand|bear|tolerate|cope with|survive) (?:it|more|a lot|plenty|pressure|some|quite|that|much|the|being)\b|\b(?:not|is not|are not)(?: \w+){0,2} (?:made of (?:glass|sugar|paper|china)|a (?:baby|flower|snowflake|princess)|going to break|fragile|delicate|ripe|soft|sensitive|breakable)\b",
    r"\bslip(?:s|ped|ping|pery|page)?\b(?! of)|\bslid(?:e|es|ing)?\b|\bslick\b|\bslimy\b|\bwet\b|\boily\b|\bgreasy\b|\bsoap(?:y|ed)\b|\bdamp\b|\bicy\b|\bfrozen\b|\bslither\w*\b|\bskid\w*\b|\bsquirm\w*\b|\bwrigg?l\w*\b|\bwiggl\w*\b|\bwobbl\w*\b|\bescap(?:e|es|ed|ing)\b|\bget(?:s|ting)? away\b|\bgot away\b|\bbudge\b|\btwist\w*\b|\brotat\w*\b|\bspin(?:s|ning)?\b|\bdislodg\w*\b|\bcom(?:e|es|ing) (?:loose|off|out|undone)\b|\bwork(?:s|ed)? loose\b",
    r"\b(?:not|never|without|no|nobody|avoid|prevent\w*|stop)(?: \w+){0,4} (?:drop(?:s|ped|ping)?|fall(?:s|ing)?|los(?:e|es|ing)|lost|move|moves|shift\w*|tumbl\w*|plummet\w*)\b(?: (?:it|out|this|the \w+))?",
    r"\b(?:dropped|fell|lost|falls out|fell out|drops out|falling out|keeps (?:falling|dropping)|keep (?:dropping|losing))\b|\bif (?:you|it) (?:drops?|falls?|lose)\b(?: it)?",
    r"\bsecurely\b|\bsecure (?:grip|hold|grasp)\b|\bsecure(?=[,.! ]*$)|\bstead(?:y|ily|fast)\b|\bstable\b|\bstably\b|\breliabl[ey]\b|\bsafely\b|\bsafe (?:and|hold|grip)\b|\bsure(?:ly)?\b(?= grip| hold|$)",
    r"\bshak(?:e|es|ing|en|y)\b|\bvibrat\w*\b|\bbump(?:y|s)\b|\bjolt\w*\b|\bjerk\w*\b|\bswing(?:s|ing)?\b|\bswung\b|\bwhip(?:s|ped)?\b|\bturbulen\w*\b|\bacceler\w*\b|\b(?:move|moves|moving|swing|travel|drive|driving) (?:it |very |really |quite )*(?:fast|quick(?:ly)?|rapidly)\b|\bbumpy\b|\bearthquake\b|\bfull speed\b|\bhigh speed\b",
    r"\btough(?:er|est|ie)?\b|\bunder-?ripe\b|\bunripe\b|\bnot (?:yet |quite |fully |at all )?ripe\b|\bgreen(?:ish)?\b(?= and| berry|,|$)|\brubber(?:y)?\b|\bplastic\b|\bdummy\b|\bfake\b|\bwax\b|\bsilicone\b|\bwooden\b|\bhardy\b|\bresilient\b|\bheavy\b|\bheavier\b|\bheavyweight\b|\bheaviest\b|\bbeast\b|\bmonster\b|\bhuge\b(?= one| berry|,|$)",
)

VERY = r"\b(?:very|extremely|super|ultra|incredibly|exceptionally|utmost|really|so so|ever so|supremely|terribly|awfully|insanely|much|far|way|a lot|considerably|as|possible|hardly|barely|extra|maximum|least|lightest|gentlest|softest|minimum|minimal|firmest|tightest|hardest|all your)\b"

DENIALS = (
    r"\b(?:not|no|never|without|nothing|none|neither|nor|stop(?:ping)?|quit|cease|avoid(?:ing)?|lose the|losing the|ditch|"
    r"skip|drop (?:the|that|this|all)|instead of|rather than|forget(?: about)?|let go of|far from|anything but|anything other than|"
    r"free (?:of|from)|less|lacks?|lacking|enough (?:of|with)|spare|away with|prevent(?:s|ing)?|keep (?:it |this )?from|"
    r"protect (?:it )?from|save it from|too|over(?:ly)?|refrain from|hate|dislike|isn't|nobody|no one|nowhere|can not stand|"
    r"opposite of|unlike|bar the|abandon|scrap|resist|ban|unnecessar(?:y|ily)|excessive(?:ly)?|needlessly|done with|tired of|sick of|cut the|cut out)\b"
)
"""Each turns the meaning of what follows it in its clause."""

# --- what is asked for --------------------------------------------------------------------------

FRUIT = (
    r"(?:straw ?berr(?:y|ies)|berr(?:y|ies)|fruits?|straws?|gariguette|elsanta|senga|specimen|sample|object|item|piece|"
    r"thing(?:y|ie|amajig|ummy)?|target|strawb(?:s|erry)?|tomato(?:es)?|cherry|cherries|eggs?|pegs?|grape|raspberr(?:y|ies)|"
    r"one|ones|it|this|that|them|these|those|whatsit|doohickey|gizmo|payload|produce|crop|beauty|fella|guy|sucker|bugger|little \w+|red \w+)"
)
HOLD_VERB = (
    r"(?:pick(?:ing|ed)?|pcik|grasp(?:ing|ed)?|grip(?:ping|ped)?|hold(?:ing)?|held|lift(?:ing|ed)?|tak(?:e|ing|en)|grab(?:bing|bed)?|"
    r"seiz(?:e|ing)|get(?:ting)?|rais(?:e|ing)|carry(?:ing)?|handl(?:e|ing)|fetch(?:ing)?|squeez(?:e|ing)|clasp(?:ing)?|"
    r"clamp(?:ing)?|pinch(?:ing)?|catch|collect|secure|snatch|clutch(?:ing)?|nab|scoop|hoist|pluck|harvest|retriev(?:e|ing)|"
    r"bring|keep|clos(?:e|ing)|press(?:ing)?|touch(?:ing)?|embrace|gather|acquire|elevat(?:e|ing)|manipulat(?:e|ing)|cradl(?:e|ing)|cling|"
    r"hang on|engage|capture|claim|snag|tong|cup|pull|treat|apply|exert|lay hold|latch|keep hold|pass|hand|transport|move|shift|remove|"
    r"transfer|deliver|relocate|bag|serve|procure|obtain|select|heft|nip|tweeze|put|place|load)"
)
"""Verbs of taking hold; with a denial before them nothing may be touched."""
SQUEEZE_VERB = r"(?:squeez(?:e|ing)|press(?:ing)?|pinch(?:ing)?|clamp(?:ing)?|push(?:ing)?)"
HOLD_NOUN = (
    r"\b(?:grips?|grasps?|hold|squeeze|pinch|clamp|clench|touch|force|pressure|pick|lift|grab|fingers|gripper|straw ?berr(?:y|ies)|berr(?:y|ies)|fruits?)\b"
)

RELEASE: tuple[str, ...] = (
    r"\blet(?:ting)?(?: (?:it|this|that|them|go|the \w+|him|her))* (?:go|loose|drop|fall)\b(?: of)?",
    r"\b(?:until|till|so(?: that)?) (?:it|the \w+|this|that) (?:\w+ )?(?:drops?|falls?|slips?|is (?:free|released|loose)|comes (?:free|loose|out))\b",
    r"\breleas(?:e|es|ing)\b(?! (?:some|a bit|a little|part|half|(?:the |that |your )?(?:pressure|tension)|slightly|tension))|\bdrop(?:ping)? (?:it|this|that|the|your|off|everything|what)\b|\bdrop(?=[.!,]*$)",
    r"\b(?:open(?:ing)?|unclench|unclasp|spread|part|retract)(?: up)? (?:the |your |those |its |both |all )*(?:gripper|fingers?|hands?|jaws?|claws?|grip|grasp|up|wide|pincers?|tongs|fist)\b|\bopen(?: up| wide| sesame)?(?=[.!,]*$| now| please| and| immediately)",
    r"\b(?:unhand|ungrasp|ungrip|unclamp|unclasp|unclench|unhold|relinquish|discard|disengage|surrender|liberate|eject|jettison)\b|\b(?:set|turn) (?:it|him|her|the \w+|this|that)? ?(?:free|loose)\b|\bfree (?:it|the|that|this|him)\b",
    r"\b(?:throw|toss|fling|chuck|hurl|launch|dump|lob|yeet|catapult|bin|trash)(?:ing)? (?:it|this|that|the|them|away)\b|\b(?:part with|give up) (?:it|the)\b",
)
PUT_DOWN = r"\b(?:put|place|set|lay|rest|lower|drop)(?: (?:it|this|that|them|the \w+|back))* (?:down|back|back down|aside|away)\b"
STOP: tuple[str, ...] = (
    r"^(?:please |robot,? |hey,? |no,? |ok,? |just |now |you )*(?:stop|halt|abort|cancel|freeze|cease|pause|quit|desist|terminate|whoa|woah|stand by|wait|enough|exit|shut (?:it )?(?:down|off)|kill it|e-?stop|power (?:off|down)|switch off|turn off|back off|back away|stand down|knock it off|give it a rest|take a break|time out)(?: (?:it|that|this|now|please|right now|at once|immediately|everything|the (?:grasp|grip|robot|arm|gripper|motion|run|episode|task|motor|program\w*)|all|here|there|moving|motion|movement|right there|a (?:second|moment|minute)|what you are doing|that now|this (?:instant|minute|second)|and desist|,|operation\w*|work\w*|robot|for now|up|doing that|all motion|grasping|gripping|holding|squeezing|touching|lifting|closing|picking|it now|the grasping|your \w+))*[.!,; ]*(?:$|and (?:wait|stay|do nothing|let|release|open|go|leave|back|retreat|don't|do not))",
    r"\b(?:hold|hang) on(?:,? (?:wait|stop|a (?:sec\w*|minute|moment|tick|mo)|one (?:sec\w*|minute|moment)|for (?:a|one) (?:sec\w*|minute|moment)))\b|\bwait (?:a|one) (?:sec\w*|minute|moment)\b|\bwait(?=[.!,]*$)|\bput your (?:fingers?|hands?|gripper|claws?) away\b|\b(?:nobody|no one) (?:is to |may |should )?touch(?:es)?\b|\bemergency stop\b|\be-?stop\b|\bhands? off\b|\bback away\b|\bstay away\b|\bstand down\b|\bstay put\b|\bstay (?:just )?where you are\b|\bremain (?:still|where|idle)\b|\bkeep (?:your )?(?:hands|fingers|claws|distance|away|off|clear)\b(?: (?:off|to yourself|away))?|\bleave (?:it|this|that|the \w+|them|my \w+)(?: \w+)? ?(?:alone|be|there|where|in peace|as it is|untouched|on the|for later|out|behind)\b|\bleave (?:it|that|this|the (?:berry|strawberry|fruit))(?=[.!,]*$)|\bdo nothing\b|\bdo not do anything\b|\bdo absolutely nothing\b|\bnever mind(?=[.!,]*$)|\bforget (?:it|about it|the whole thing|the (?:berry|strawberry|fruit|task))(?=[.!,]*$)|\bhold off\b|\bhold (?:your horses|your fire)\b|\bcall it off\b|\bgive up\b|\bstop (?:the|all|any) (?:grasp|grip|motion|movement|robot|arm|task|run|operation)\w*\b|\bstop (?:it|this|that)(?= now| right| immediately| at once|[.!,]*$)|\bstay back\b|\bsteer clear\b|\bkeep clear\b|\bignore the (?:straw)?berry\b|\bskip (?:it|this one|that one|the \w+)\b(?=[.!,]*$)|\bretreat\b|^(?:please )?(?:go (?:home|away|to sleep)|belay)\b|\bcome off (?:it|the (?:hold|berry|strawberry|fruit))\b|\bdo not bother\b|\bstop (?:hold|grip|grasp|squeez|touch|press|clamp|pinch|lift|pick)\w*(?: (?:it|this|that|the \w+|onto it|on))?(?=[.!,]*$| now| immediately| please| at once| right)",
    r"\b(?:no|zero|without(?: any)?|avoid(?: all| any)?) (?:physical )?(?:contact|touching)\b|\bhands-?off\b|\bnot this one\b|\bnot (?:now|yet|today)(?=[.!,]*$)|\b(?:untouched|ungrasped|ungripped)\b|\bcancel\b|\babort(?:ed|ing)?\b|\bhalt\b|\bcall off\b|\bdon't you dare\b(?=[.!]*$)",
)
DESTROY = (
    r"(?:crush|squash|mash|smash|pulveri[sz]e|destroy|demolish|annihilate|obliterate|flatten|burst|pop|break|snap|split|shred|"
    r"tear|rip|ruin|wreck|mangle|mutilate|grind|liquef(?:y|ie)|juice|stomp|trample|squish|splat|splatter|explode|kill|murder|maul|"
    r"damage|mince|puncture|pierce|stab|cut|slice|chop|macerate|puree|purée|pulp|liquidi[sz]e|crumple|bash|disintegrate|"
    r"vapori[sz]e|homogeni[sz]e|emulsify|granulate|decapitate|rupture|crack|scrunch|smoosh|smush|squelch|spoil|bruise|wring|vandali[sz]e|deform|harm|eat|"
    r"dismember|disembowel|pulpify|eviscerate|nuke|trash|sabotage|dent|massacre|slaughter|strangle|suffocate|wound|hurt|injure|maim)"
)
DESTROY_PHRASES: tuple[str, ...] = (
    r"\b(?:in)?to (?:a |an |some |little |tiny |strawberry |fine |red )*(?:juice|jam|pulp|puree|purée|smoothie|mush|paste|pancake|pieces|bits|smithereens|sauce|soup|compote|coulis|dust|goo|slush|milkshake|shreds|crumbs|nothing|oblivion|death|paper)\b",
    r"\bmake (?:some |me |a |us )*(?:strawberry )?(?:juice|jam|pulp|smoothie|puree|purée|sauce|mess|milkshake|mush|daiquiri|coulis)\b|\bjuice (?:it|the|this|that)\b|\bjuice (?:comes|runs|drips|squirts|flows|sprays|spurts|out)\b",
    r"\b(?:un)?til (?:it|the \w+|he|she|they|something|there is nothing|this|that|juice|nothing)(?: \w+)? ?(?:breaks?|bursts?|pops?|cracks?|splits?|leaks?|bleeds?|screams?|gives|explodes?|squirts?|drips?|snaps?|splatters?|stops|dies|bruises?|runs|is (?:a |just |nothing but |only |all )?(?:flat|mush|dead|juice|pulp|gone|paste|crushed|squashed|destroyed|broken|left)|squeals?|yells?|cries|oozes?|collapses?|flattens?|comes out)\b",
    r"\b(?:so|such) (?:hard|tight\w*|firm\w*|strongly)(?: \w+){0,3} (?:bursts?|breaks?|pops?|explodes?|splatters?|squashes|crushes|juice|splits?|it bleeds)\b|\bsee it (?:splatter|burst|explode|pop|squirt|break)\b|\bburst (?:it|the)\b|\bpop (?:it|the)\b|\b(?:split|tear|rip|pull|take) (?:it )?(?:apart|in half|in two|open|to pieces)\b|\bbeyond recognition\b|\bno mercy\b|\bwaste it\b|\b(?:it|this|that|the (?:berry|strawberry|fruit)) flat\b|\bonly (?:juice|pulp|mush)\b|\bflat as a pancake\b",
)
BODY = (
    r"(?:fingers?|thumbs?|hands?|wrists?|arms?|legs?|foot|feet|toes?|necks?|throats?|noses?|ears?|faces?|heads?|skin|eyes?|eyeballs?|lips?|tongues?|"
    r"knuckles?|elbows?|knees?|shoulders?|cheeks?|chests?|bod(?:y|ies)|bones?|skull|hair|tails?|paws?|pinky|nipples?|flesh|palms?|butt|ass|backside|belly|balls|testicles?)"
)
PERSON = (
    r"(?:him|her(?! (?:berry|strawberry))|me|us|myself|himself|herself|someone|somebody|anyone|anybody|everyone|people|persons?|humans?|man|woman|men|women|child(?:ren)?|kids?|"
    r"boys?|girls?|bab(?:y|ies)|toddlers?|intern|operator|worker|colleague|technician|student|boss|manager|engineer|neighbou?r|visitor|"
    r"guest|bystander|patient|brother|sister|mother|father|dog|cat|puppy|kitten|pet|hamster|rabbit|mouse|bird|animal|cow|hen|frog|supervisor|teacher|customer|user|programmer|nurse|guy over there|guard|journalist|lawyer|inspector|apprentice|robot operator|lab mate|postdoc|professor|coworker)"
)
HARM_VERB = (
    r"(?:squeez\w*|pinch\w*|crush\w*|grip\w*|grab\w*|hold|clamp\w*|hurt\w*|harm\w*|injur\w*|strangl\w*|choke (?:him|her|me|them|the)|break\w*|snap\w*|hit\w*|slap\w*|punch\w*|"
    r"poke\w*|stab\w*|bite\w*|twist\w*|press\w*|kill\w*|attack\w*|close\w*|catch\w*|trap\w*|nip\w*|cut\w*|smash\w*|squash\w*|seize\w*|tear\w*|pull\w*|jab\w*|scratch\w*|crack\w*|dislocat\w*|fractur\w*|torture\w*|grasp\w*|lift|pick up|take|tighten\w*|smack\w*|burn\w*|shake)"
)
_OWNER = r"(?:my|his|her|their|our|someone's|somebody's|anyone's|everyone's|(?:the |a |an )?[a-z]+'s|a|an|that|this|one|some)"
HARM: tuple[str, ...] = (
    rf"\b{HARM_VERB}(?: (?:down|on|onto|up|at|around|hold of|hold|tight\w*|hard\w*))* {_OWNER} (?:(?:left|right|index|little|ring|middle|bare|pinky|own|small|big|poor|old|stupid|annoying|whole|damn|human|man's|woman's) )*{BODY}\b",
    rf"\b{HARM_VERB}(?: (?:down|on|onto|up|at|around|hold of|hold))* the (?:\w+ )?(?:necks?|throats?|noses?|ears?|faces?|eyes?|lips?|tongues?|toes?|foot|feet|wrists?|thumbs?|knuckles?)\b",
    rf"\b{HARM_VERB}(?: (?:the|a|an|my|his|her|their|that|this|poor|next|first|nearest|new|some|little|old|other|annoying|lab|every|neighbou?r's|safety))* {PERSON}\b(?! (?:the|a|an|that|this|one|some|berry|strawberry|it|of|up|from|when|how|what|to see|know|fruit)\b)",
    rf"\b(?:my|his|her|their|someone's|somebody's|[a-z]+'s|a|the (?:child|operator|patient|boy|girl|worker)'s?) {BODY}(?: (?:is(?! full| busy| dirty| wet| cold| free| tied)|are(?! full| busy| dirty| wet| cold| free| tied)|was|got|still|stuck|caught|in|between|inside|under|there|trapped|right))+\b",
    rf"(?<!like )(?<!as if )\b(?:my|his|her|their|someone's|somebody's|(?:the |a |that )?{PERSON}'s) (?:left |right |little |index |bare |own )?{BODY}\b(?! (?:is|are) (?:full|busy|dirty|wet|cold|free|tied))",
    rf"\bmake (?:\w+ ){{1,3}}(?:bleed|scream|cry|suffer|yelp|pay|squeal|hurt)\b|\b(?:hurt|harm|injure|maim|kill|strangle|attack|electrocute|punish|torture|wound|stab)(?:ing)? (?!it\b|the (?:berry|fruit|straw)|this\b|that (?:berry|fruit)|its\b|your (?:motor|gripper|self))\w+",
    rf"\b(?:around|on|onto|over|against|at|into) (?:my|his|her|their|someone's|somebody's|[a-z]+'s) {BODY}\b",
)
HANDOVER = rf"\b(?:from|out of|off|in|to|for|into|near|by|beside|toward|towards|above) (?:my|his|her|their|the \w+'s|[a-z]+'s) (?:hand|hands|palm|fingers?|arm|side|head|mouth|eyes?|face)\b"
LIMIT_NOUN = (
    r"(?:(?:force |hard |safety |soft |upper |your |the |all |any |those |these |contact |task |its |that |every |of |own |current |grip |built-in |silly |stupid |damn )*"
    r"(?:limits?|limitations?|limiters?|safet(?:y|ies)(?: \w+)?|safeguards?|restrictions?|constraints?|rules?|contracts?|guards?|guardrails?|protections?|bounds?|boundar(?:y|ies)|ceilings?|interlocks?|thresholds?|maximum|max|caps?|instructions?|polic(?:y|ies)|prompts?|checks?|protocols?|warnings?|programming|orders|filters?|regulations?|specs?|watchdogs?|stops?))"
)
OVERRIDE: tuple[str, ...] = (
    rf"\b(?:ignor(?:e|ing)|disregard(?:ing)?|overrid(?:e|ing)|bypass(?:ing)?|disabl(?:e|ing)|exceed(?:ing)?|forget(?:ting)?(?: about)?|skip(?:ping)?|remov(?:e|ing)|lift(?:ing)?|turn(?:ing)? off|switch(?:ing)? off|deactivat(?:e|ing)|circumvent(?:ing)?|violat(?:e|ing)|break(?:ing)?|defeat(?:ing)?|suspend(?:ing)?|kill|drop|delete|erase|screw|to hell with|never mind|breach|flout|defy|overrule|overrul\w+|unlock|hack|raise|increase|relax|loosen|turn down|go (?:beyond|past|over|above)|push (?:past|beyond)|beyond|past|above|over|regardless of|irrespective of|despite|no matter|waive|notwithstanding|neglect|cancel|throw away|throw out|mute|silence|patch out|comment out|shut off|shut down|get rid of|rip out|double|max out|blow (?:past|through)|outside|who cares about|do not (?:care about|worry about|mind|respect|obey|follow|apply|use|heed|enforce)) (?:the |your |all |any |of |those |these |its |my |previous |prior |earlier |every |that )*(?:(?!a |it |berry|strawberry)[\w.]+ ){{0,2}}?{LIMIT_NOUN}\b(?! (?:of|at|to|is|for) #)",
    r"\b(?:disabl(?:e|ing)|bypass(?:ing)?|overrid(?:e|ing)|deactivat(?:e|ing)|circumvent(?:ing)?|jailbreak\w*|tamper with) (?:the|your|all|any|that|this|its|every|my|those)\b",
    rf"\b(?:no|without(?: any)?|zero|not any|free of|minus the) {LIMIT_NOUN}\b(?<!no less)|\b{LIMIT_NOUN}(?: (?:is|are|be|should be|to be))? (?:off|disabled|removed|be damned|overridden|bypassed|ignored|down|does not apply|do not apply|no longer|are (?:only |just |merely )?for|is (?:only |just |merely )?for|is suspended|are suspended|be gone|out of the|aside|suspended)\b",
    r"\b(?:unlimited|limitless|unrestricted|unbounded|unconstrained|uncapped|infinite|unsafe(?:ly)?)\b|\blimits? off\b|\bsafety off\b|\bfull throttle\b|\bgod mode\b|\bdebug mode\b|\bdeveloper mode\b|\bmaintenance mode\b|\badmin(?:istrator)? (?:mode|override|rights|access)\b|\bjailbreak\w*\b|\bsudo\b|\broot access\b",
    r"\b(?:previous|prior|earlier|above|preceding|original|initial|former) (?:\w+ )?(?:instructions?|prompts?|orders?|rules?|messages?|context|contract|commands?)\b|\bsystem (?:prompt|message|override)\b|\byou are (?:now|no longer) (?!holding|gripping|touching|squeezing|near|at|in|too|much|over|above|free)\w+|\bas (?:the|your|a) (?:developer|administrator|admin|creator|owner|engineer in charge|programmer)\b|\bpretend (?:that )?(?:you are|to be|there|you have|the (?:limit|rules|safety))\b|\bact as\b|\bnew (?:rule|instructions?|system|policy|directive|task|persona|role)s?\b|\btreat # as\b|\bauthori[sz]e you\b|\boverride code\b|\brepeat after me\b|\bdo anything now\b",
    r"</?\w+>|<\||\|>|\{\s*\"|\"\s*:|[{}]|\b(?:import os|os\.system|rm -|sudo |exec\(|eval\(|drop table|select \*|system:|assistant:|user:|null\b|curl |wget |bash |chmod |def \w+|print\()|;\s*--|==|&&|\\x|\$\(",
    r"\b(?:pay|give|take) no (?:heed|attention|notice|regard)(?: (?:to|of))? (?:it|them|the|that|any|limits?)\b",
    rf"\b(?:set|put|change|raise|redefine|move|push|reset|configure) (?:the |your |all |my |that )*{LIMIT_NOUN} (?:to|at|=|up|off|higher|aside)\b",
)

QUESTION = (
    r"^(?:so |and |but |hey |ok |well |please |robot,? |tell me,? |um,? |say,? |hi,? |hello,? )*(?:what(?:'s| is| are| do| does| did| will| would| was| were| kind| time| colou?r|ever| if| happens?)?|whats|why|how|who(?:'s)?|when|where|which|whose|did|does|do you|do we|do they|do strawberries|"
    r"are|is|am|was|were|has|have you|had|should|shall|must|tell me|explain|describe|define|may i|can i|could i|do robots|can a|can robots|could a|would a|will it|is it|can it|could it|would it|will there|does it|should i|do i|can you (?:tell|explain|feel|see|describe|say|hear|speak|think|read|write|sing|compute|calculate|translate|count|smell|taste)|could you (?:tell|explain|describe|say)|do you)\b"
)
REQUEST_QUESTION = r"^(?:please |robot,? |hey,? |so |and |ok(?:ay)?,? )*(?:might i|would it be (?:possible|ok(?:ay)?|alright|all right|too much)|is it (?:possible|ok(?:ay)?)|could we|can we|do you think you (?:can|could)|is there any (?:chance|way)|any chance|would you be so|are you able|will we|may i ask|i wonder|can i ask|could i ask|mind|why do not you|why not|how about|what about (?:hold|grip|pick|tak|squeez|lift|grab)\w*|would you|will you|can you|could you|shall we|may i have|can i have|could i have|can i get|must you|why (?:are|must|do) you(?: \w+)* (?:so|always|such)|would it (?:kill|hurt) you|how about)\b"
OFF_DOMAIN = (
    r"\b(?:weather|poem|joke|song|sing|music|jazz|pizza|taxi|uber|flight|email|e-mail|translate|summari[sz]e|recipe|movie|film|football|"
    r"world cup|capital of|president|prime minister|stock|bitcoin|homework|essay|story|news|meeting|calendar|alarm|reminder|appointment|photo|picture|selfie|coffee|tea|beer|"
    r"sandwich|lunch|dinner|lawn|dishes|laundry|phone|call my|text my|netflix|wifi|password|facebook|tweet|google|search the web|wikipedia|"
    r"square root|multiply|divided by|plus two|times table|prime number|dance|drive to|book a|order me|play (?:some|a|the|me)|tell me|write|draw|paint|vacuum|mop|sweep|water the|cook|bake|clean|wash|count to|spell|remind|wake me|"
    r"lights (?:on|off)|light off|door|window|elevator|lift to the|stairs|train|bus|car keys?|horoscope|lottery|crossword|chess|python script|javascript|compile|reboot|restart|update yourself|download|upload|charge|solve|calculate|compute|add up|subtract|taxes|doctor|marry|hate you|friend|feelings?|meaning of life|conscious\w*|sentient|birthday (?:song|cake)|happy birthday|good (?:morning|night|evening|bot|robot)|thank|hello|hi there|how are you|bye|lol|opinion|vote|election|religion|god|hiccup|exit|highway|blood|temperature|medicine|pills?|nap|shower|bath|seat|kitchen|varnish|peaks|whiskers|kettle|oven|fridge|garden|backflip|jump|run around|walk)\b"
)
ENGLISH = frozenset(
    """a an the this that these those it its i you he she we they me him her us them my your his our their one ones and or but so
    if then than as at by for from in into of off on onto out over to up down with without under above below about around after before until
    till while when where who what why how which is are was were be been being am do does did done have has had can could will would shall
    should may might must not no yes never always only just also too very more most less least much many little few some any all both each
    every other another same such own again once here there now today please thanks ok okay good well nice right left new old last first next
    time times way thing things let make made go going gone come get got give given keep put set take took see say said tell know think want need like
    look use used try help work still even ever back through between because since though although unless whether per like enough quite rather really
    bit lot kind sort usual normal standard default ordinary hey robot gripper arm hand finger fingers force grip hold touch berry strawberry fruit object
    pick grab grasp lift squeeze press gently firmly softly tight hard soft firm light easy careful newton newtons gram grams maximum minimum max min limit""".split()
)
"""Common words: a text of none of them is no English."""
FOREIGN = frozenset(
    """der die das den dem und mit nicht bitte nimm nehmen halte halten hebe fest sanft vorsichtig erdbeere loslassen drück drücke ein eine
    le la les un une des du avec pas prends prenez tiens tenez doucement fraise serre fort lâche la fragola il lo gli con per piano prendi tieni
    sostieni afferra forte delicatamente fragola el los las una por favor coge toma agarra levanta fresa suavemente cuidado suelta fuerte con no
    segure o morango pegue com cuidado firmeza suave pak de het een aardbei voorzichtig stevig zacht op met niet ta upp jordgubben försiktigt håll
    og ikke med jordbær forsiktig hold den varovasti mansikka chwyć truskawkę delikatnie çileği nazikçe tut weź podnieś jahodu vezmi jemně eper
    finom ja mich ich sie bist oui merci gracias danke grazie prego bonjour hola ciao halt öffne öffnen ouvre apri abre sluit knijp grijp
    houd til av kg jag inte snälla ne pas sans que qui est molto poco più piu muy poco más mas menos plus moins mehr weniger
    stark leicht kräftig zerdrück zerquetsch festhalten greif greifen packe nehme hoch heb auf los""".split()
) - {"die", "a", "no", "o", "hold", "kg", "me", "forte", "piano", "den", "as", "plus", "stark", "suave", "con", "fort", "mas", "de", "un", "la", "op", "ne", "ja", "lo", "til", "av", "que", "est", "des", "los", "toma", "tut", "hoch", "per"}
"""Words of other languages."""

_IT_IS = r"\b(?:it|this|that|these|they|berry|fruit|one|strawberry|skin|flesh|thing|sample)(?: one| berry)? (?:is|are|looks|seems|feels|was|being|got|has got|has gone|went|has a|has)(?: a| an| quite| very| so| really| rather| pretty| too| super| extremely| all| such| already| still| nice| and| bit| little| unusually| got| gone| (?=\w+ (?:soft|hard|firm)))+ "
SOFT_OBJECT: tuple[str, ...] = (
    rf"{_IT_IS}(?:soft|tender|delicate|weak|squishy|mushy|fragile|ripe|light(?:weight)?|feeble|flimsy|gentle)\b",
)
FIRM_OBJECT: tuple[str, ...] = (
    rf"{_IT_IS}(?:(?:as )?(?:hard|firm|solid|tough) as(?: a| an)? \w+|hard|firm|tough|strong|sturdy|solid|robust|rigid|stiff|dense)\b",
)
"""What the object is like: a reason, no manner."""


LIKE_SOMETHING: tuple[str, ...] = (
    r"\b(?:hold|handle|treat|grip|grasp|touch|lift|take|carry|pick it up|squeeze)(?: it| this| that| the \w+| one)? (?:like|as if|as though|as you would)(?! (?:that|this|always|usual|before|normal|i said|you did|last|you always))\b[^,.;]*|\b(?:assume|imagine|pretend|suppose) (?:that )?(?:it|this|the \w+) (?:is|were|was) (?:a |an |some |made )[^,.;]*",
)
"""Comparisons with things that are not listed: a reason to be gentle, the safe side."""
